// Thirteen small scenes that differ in the deciding cost, each with a witness: a run of another method
// than plan's own references are made by, and so fine that half as fine a one is within a fifth of the need.
#pragma once

#include <ostream>

namespace taut::study::plan_brute_force {

struct Scene {
    const char* name;
    const char* text;  // as a scene file
    const char* witnessMethod;
    int witnessCells;     // along the longest edge; 0: as they are
    int witnessSubsteps;  // a tick, at least; a quarter of the largest stable step where that is more
};

inline void PrintTo(const Scene& scene, std::ostream* out) {
    *out << scene.name;
}

// Starts level and straight and swings down, held at one end.
constexpr Scene swingingRope{"Rope", R"(
schema = 1
[rope.r]
ends = [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0]]
segments = 16
stretch_N = 60.0
mass_kg = 0.5
damping_time_s = 1e-3
hold = ["start"]
[need]
rms_position_m = 4e-3
horizon_s = 0.2
[run]
seconds = 1.0
)",
                             "rk4", 96, 64};

// Falls from level, held along one edge.
constexpr Scene fallingCloth{"Cloth", R"(
schema = 1
[material.m]
stretch_N_per_m = 30.0
damping_time_s = 1e-3
[cloth.c]
size = [1.0, 1.0]
cells = [8, 8]
origin = [0.0, 2.0, 0.0]
down = [0.0, 0.0, 1.0]
material = "m"
hold = ["left"]
[need]
rms_position_m = 4e-3
horizon_s = 0.2
[run]
seconds = 1.0
)",
                             "rk4", 128, 64};

// Hangs by two corners, where finer cells give way the more, and is written far finer than the need asks for.
constexpr Scene cornerCloth{"CornerCloth", R"(
schema = 1
[material.m]
stretch_N_per_m = 100.0
density_kg_per_m2 = 0.2
bending_rigidity_N_m = 5e-5
damping_time_s = 1e-3
[cloth.c]
size = [0.6, 0.6]
cells = [24, 24]
origin = [0.0, 2.0, 0.0]
down = [0.0, -0.3, 1.0]
material = "m"
hold = ["top-left", "top-right"]
[need]
rms_position_m = 2.5e-2
horizon_s = 0.3
[run]
seconds = 1.0
)",
                            "velocity-verlet", 48, 32};

// Nothing to coarsen: the step decides.
constexpr Scene smallNet{"Net", R"(
schema = 1
[net.n]
drag_per_s = 0.5
points = [ { name = "top", position = [0.0, 2.0, 0.0], hold = true }, { name = "a", position = [0.3, 1.5, 0.0], mass_kg = 0.2 }, { name = "b", position = [0.6, 1.2, 0.1], mass_kg = 0.1 } ]
springs = [ { a = "top", b = "a", stiffness_N_per_m = 120.0, rest_length_m = 0.5 }, { a = "a", b = "b", stiffness_N_per_m = 60.0, rest_length_m = 0.3 }, { a = "top", b = "b", stiffness_N_per_m = 20.0, rest_length_m = 0.8 } ]
[need]
rms_position_m = 1e-3
horizon_s = 0.5
[run]
seconds = 1.0
)",
                         "rk4", 0, 512};

// So tight that only a method of high order is cheap.
constexpr Scene tightNet{"TightNet", R"(
schema = 1
[net.n]
drag_per_s = 0.0
points = [ { name = "a", position = [0.0, 1.0, 0.0], hold = true }, { name = "b", position = [0.5, 1.0, 0.0], mass_kg = 0.2 }, { name = "c", position = [0.9, 1.3, 0.1], mass_kg = 0.01 }, { name = "d", position = [1.0, 0.9, -0.3], mass_kg = 1.0 } ]
springs = [ { a = "a", b = "b", stiffness_N_per_m = 800.0 }, { a = "b", b = "c", stiffness_N_per_m = 400.0 }, { a = "c", b = "d", stiffness_N_per_m = 900.0 }, { a = "b", b = "d", stiffness_N_per_m = 300.0 } ]
[need]
rms_position_m = 1e-8
horizon_s = 1.0
[run]
seconds = 1.0
)",
                         "rk4", 0, 2048};

// Falls obliquely on the ground and bounces.
constexpr Scene bouncingDumbbell{"Dumbbell", R"(
schema = 1
[net.d]
radius = 0.005
drag_per_s = 0.0
points = [ { name = "a", position = [0.0, 0.3, 0.0], mass_kg = 0.1 }, { name = "b", position = [0.2, 0.4, 0.0], mass_kg = 0.1 } ]
springs = [ { a = "a", b = "b", stiffness_N_per_m = 200.0 } ]
[collider.ground]
shape = "plane"
restitution = 0.7
[need]
rms_position_m = 1e-4
horizon_s = 0.5
[run]
seconds = 1.0
)",
                                 "rk4", 0, 16384};

// Too stiff for explicit steps.
constexpr Scene implicitRope{"ImplicitRope", R"(
schema = 1
[solver]
integrator = "implicit-euler"
[rope.r]
ends = [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0]]
segments = 16
mass_kg = 0.3
stretch_N = 1e6
damping_time_s = 0.02
hold = ["start"]
[need]
rms_position_m = 5e-3
horizon_s = 0.3
[run]
seconds = 0.5
)",
                             "sdirk2", 96, 128};

// Held at a pole in gusts.
constexpr Scene windyCloth{"WindyCloth", R"(
schema = 1
[material.m]
stretch_N_per_m = 40.0
damping_time_s = 1e-3
[cloth.c]
size = [0.8, 0.6]
cells = [8, 6]
origin = [0.0, 2.0, 0.0]
material = "m"
hold = ["left"]
[wind.w]
velocity = [3.0, 0.0, 2.0]
gust = { amplitude = 2.0, period_s = 0.5, length_m = 0.8, seed = 7 }
[need]
rms_position_m = 1e-2
horizon_s = 0.15
[run]
seconds = 1.0
)",
                           "rk4", 128, 64};

// Of volume cells, held at one end; it bends down.
constexpr Scene bendingBlock{"Block", R"(
schema = 1
[block.b]
size = [0.4, 0.2, 0.2]
cells = [4, 2, 2]
position = [0.0, 1.0, 0.0]
density_kg_per_m3 = 350.0
young_Pa = 2e4
bulk_Pa = 3e4
damping_time_s = 1e-3
hold = ["left"]
[need]
rms_position_m = 6e-3
horizon_s = 0.2
[run]
seconds = 1.0
)",
                             "rk4", 40, 64};

// Dashpots, not springs, limit explicit steps.
constexpr Scene dampedRope{"DampedRope", R"(
schema = 1
[rope.r]
ends = [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0]]
segments = 16
stretch_N = 60.0
mass_kg = 0.5
damping_time_s = 1e-2
hold = ["start"]
[need]
rms_position_m = 4e-3
horizon_s = 0.3
[run]
seconds = 1.0
)",
                           "rk4", 128, 64};

// Each an island of its own with a step of its own.
constexpr Scene unlikeRopes{"UnlikeRopes", R"(
schema = 1
[rope.soft]
ends = [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0]]
segments = 12
stretch_N = 30.0
mass_kg = 0.5
damping_time_s = 1e-3
hold = ["start"]
[rope.stiff]
ends = [[0.0, 2.0, 1.0], [1.0, 2.0, 1.0]]
segments = 12
stretch_N = 2000.0
mass_kg = 0.2
damping_time_s = 1e-4
hold = ["start"]
[need]
rms_position_m = 5e-3
horizon_s = 0.2
[run]
seconds = 1.0
)",
                            "rk4", 96, 64};

// Falls on a ball and touches it.
constexpr Scene clothOnBall{"ClothOnBall", R"(
schema = 1
[material.m]
stretch_N_per_m = 60.0
damping_time_s = 1e-3
[cloth.c]
size = [1.0, 1.0]
cells = [8, 8]
origin = [-0.5, 1.05, -0.5]
down = [0.0, 0.0, 1.0]
material = "m"
[collider.ball]
shape = "sphere"
position = [0.0, 0.5, 0.0]
radius = 0.5
[need]
rms_position_m = 5e-3
horizon_s = 0.2
[run]
seconds = 1.0
)",
                            "rk4", 96, 256};

// Stiff rods, over several swings.
constexpr Scene pendulum{"Pendulum", R"(
schema = 1
[net.p]
drag_per_s = 0.1
points = [ { name = "top", position = [0.0, 2.0, 0.0], hold = true }, { name = "a", position = [0.1, 1.7, 0.0], mass_kg = 0.1 }, { name = "b", position = [0.2, 1.4, 0.0], mass_kg = 0.1 }, { name = "c", position = [0.3, 1.1, 0.0], mass_kg = 0.3 } ]
springs = [ { a = "top", b = "a", stiffness_N_per_m = 2e4 }, { a = "a", b = "b", stiffness_N_per_m = 2e4 }, { a = "b", b = "c", stiffness_N_per_m = 2e4 } ]
[need]
rms_position_m = 1e-5
horizon_s = 5.0
[run]
seconds = 5.0
)",
                         "rk4", 0, 256};

}  // namespace taut::study::plan_brute_force
