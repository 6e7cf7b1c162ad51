// Sliders of rigid bodies against theory, and places of joints in the axes of the world.
#include <gtest/gtest.h>

#include <cmath>

#include "support/timelines.h"
#include "taut/world/world.h"
#include "unit/scene_support.h"
#include "unit/world_places.h"

namespace taut::world::sliders {
namespace {

using support::run;

constexpr double g = 9.81, pi = 3.14159265358979323846;

SceneSpec sceneOf(const std::string& gravity, const std::string& text) {
    return scene::loadSceneText(
               "schema = 1\n[run]\nfps = 100\nseconds = 10\n[solver]\nprecision = \"double\"\n[world]\ngravity = " +
                   gravity + "\n[collider.post]\nshape = \"sphere\"\nradius = 0.01\nposition = [0, 2, 0]\n" + text,
               "slider.toml", {})
        .spec;
}

// A box of 0.4 kg whose centre is 0.3 m beside the line, so that a slider alone keeps it from turning.
std::string block(const std::string& more = "") {
    return "[solid.block]\nshape = \"box\"\nsize = [0.2, 0.1, 0.1]\nmass_kg = 0.4\nposition = [0, 2, 0.3]\n"
           "collide = false\ndrag_per_s = 0\n" +
           more;
}

// Of the block on the post, along a line that falls by 30°.
std::string slider(const std::string& more = "") {
    return "[[joint]]\na = \"collider.post\"\nb = \"solid.block\"\nkind = \"slider\"\nplace = [0, 0, 0]\n"
           "axis = [" +
           std::to_string(std::cos(pi / 6)) + ", -0.5, 0]\n" + more;
}

// [m] Along and across the line, and [rad] the turn.
struct Way {
    double along, across, turn;
};
Way wayOf(const World& world) {
    const dvec3 line(std::cos(pi / 6), -0.5, 0), way = middle(world, "solid.block") - dvec3(0, 2, 0.3);
    const dvec3 edge = middle(world, "solid.block@right") - middle(world, "solid.block@left");
    const double along = glm::dot(way, line);
    return {along, lengthOf(way - along * line), lengthOf(edge / lengthOf(edge) - dvec3(1, 0, 0))};
}

// On a spring of k from the post's line, it swings by s = (1 - cos(√(k/m) t)) m g sin 30° / k. Free, it falls by half
// of g t²/2. Both to 1e-4 of the way, with an opening and a turn below 1e-4.
TEST(Slider, AMassFallsAndSwingsAlongItsLine) {
    for (const double stiffness : {0.0, 40.0}) {
        World world(sceneOf("[0, -9.81, 0]",
                            block() + slider() +
                                (stiffness > 0 ? "[collider.hook]\nshape = \"sphere\"\nradius = 0.01\nposition = [" +
                                                     std::to_string(-10 * std::cos(pi / 6)) +
                                                     ", 7, 0.3]\n[[joint]]\na = \"solid.block@centre\"\nb = "
                                                     "\"collider.hook\"\nkind = \"spring\"\nplace = [0, 0, 0]\n"
                                                     "stiffness_N_per_m = 40\ndamping_time_s = 0\nrest_length_m = 10\n"
                                               : "")));
        const double energy = world.metrics().energy();
        double across = 0, turn = 0;
        for (int i = 0; i < 100; ++i) {
            run(world, 1);
            const Way way = wayOf(world);
            across = std::max(across, way.across);
            turn = std::max(turn, way.turn);
        }
        const double t = world.time(), swing = 0.4 * g * 0.5 / 40;
        const double wanted = stiffness > 0 ? swing * (1 - std::cos(10 * t)) : 0.25 * g * t * t;
        EXPECT_NEAR(wayOf(world).along / wanted, 1, 1e-4) << stiffness;
        EXPECT_LT(across, 1e-4 * 0.3) << stiffness;
        EXPECT_LT(turn, 1e-4) << stiffness;
        EXPECT_NEAR(world.metrics().energy(), energy, 1e-4 * 0.4 * g) << stiffness;
    }
}

// A spinning box along whose axis another one slides, in free flight: the second is driven out as a bead on a rod.
TEST(Slider, KeepsMomentumAndEnergyOfFreeBodies) {
    World world(sceneOf("[0, 0, 0]",
                        "[solid.rod]\nshape = \"box\"\nsize = [2, 0.1, 0.1]\nspin_rad_per_s = [0, 0, 1]\n"
                        "touch = \"nothing\"\ndrag_per_s = 0\n[solid.bead]\nshape = \"box\"\nsize = [0.2, 0.3, 0.2]\n"
                        "position = [0.3, 0, 0.1]\nvelocity = [0.5, 0.3, 0]\nspin_rad_per_s = [0, 0, 1]\n"
                        "touch = \"nothing\"\ndrag_per_s = 0\n"
                        "[[joint]]\na = \"solid.rod\"\nb = \"solid.bead\"\nkind = \"slider\"\nplace = [0.3, 0, 0]\n"
                        "axis = [1, 0, 0]\n"));
    run(world, 1);
    const Metrics before = world.metrics();
    for (int i = 0; i < 100; ++i) run(world, 1);
    const Metrics after = world.metrics();
    EXPECT_LT(lengthOf(after.momentum - before.momentum), 1e-6);
    EXPECT_LT(lengthOf(after.angularMomentum - before.angularMomentum), 1e-6);
    EXPECT_NEAR(after.energy() / before.energy(), 1.0, 1e-3);
    // Across the rod, and turned against it.
    const dvec3 a = middle(world, "solid.rod@left"), b = middle(world, "solid.rod@right"),
                along = (b - a) / lengthOf(b - a);
    const dvec3 d = middle(world, "solid.bead") - a,
                edge = middle(world, "solid.bead@right") - middle(world, "solid.bead@left");
    EXPECT_GT(glm::dot(d, along), 1.8);  // 1.3 m at the start
    EXPECT_NEAR(lengthOf(d - glm::dot(d, along) * along), 0.1, 1e-4);
    EXPECT_LT(lengthOf(edge / lengthOf(edge) - along), 1e-4);
}

// Damping c: v0 exp(-c t/m). Friction F: v0 - F t/m, then at rest; on a slope more than the weight's part holds. A
// motor F: the same towards its speed. And limits end the way.
TEST(Slider, LimitsFrictionDampingAndMotorAreTheirForces) {
    const auto rateAfter = [&](const std::string& more, int ticks) {
        World world(sceneOf("[0, 0, 0]",
                            block("velocity = [" + std::to_string(std::cos(pi / 6)) + ", -0.5, 0]\n") + slider(more)));
        run(world, ticks);
        return world.metrics().momentum.x / std::cos(pi / 6) / 0.4;
    };
    EXPECT_NEAR(rateAfter("", 100), 1.0, 1e-6);
    EXPECT_NEAR(rateAfter("damping_N_s_per_m = 0.4\n", 100), std::exp(-1.0), 2e-3);
    EXPECT_NEAR(rateAfter("friction_N = 0.2\n", 100), 0.5, 0.006);
    EXPECT_NEAR(rateAfter("friction_N = 0.2\n", 250), 0.0, 1e-9);
    EXPECT_NEAR(rateAfter("motor_m_per_s = -0.3\nmotor_N = 0.2\n", 100), 0.5, 0.006);
    EXPECT_NEAR(rateAfter("motor_m_per_s = -0.3\nmotor_N = 0.2\n", 400), -0.3, 1e-6);
    for (const auto& [more, wanted] : {std::pair{"friction_N = 2.5\n", 0.0},  // weight: 1.96 N
                                       {"limits_m = [-0.1, 0.25]\n", 0.25},
                                       {"limits_m = [-0.25, 0.1]\nmotor_m_per_s = -1\nmotor_N = 5\n", -0.25}}) {
        World world(sceneOf("[0, -9.81, 0]", block() + slider(more)));
        run(world, 200);
        EXPECT_NEAR(wayOf(world).along, wanted, 1e-4) << more;
        run(world, 50);
        EXPECT_NEAR(wayOf(world).along, wanted, 1e-4) << more;
    }
}

// A held solid is a rail like any other.
TEST(Slider, MayHoldAHeldSolid) {
    World world(sceneOf("[0, -9.81, 0]", block("hold = [\"all\"]\n") + slider()));
    run(world, 5);
    EXPECT_NEAR(wayOf(world).along, 0.0, 1e-12);
}

TEST(Slider, GoesOnWithTheSameBitsAndIsLetGo) {
    const SceneSpec scene =
        sceneOf("[0, -9.81, 0]", block() +
                                     slider("limits_m = [-1, 0.2]\nfriction_N = 0.5\nmotor_m_per_s = 0.5\n"
                                            "motor_N = 0.1\nname = \"s\"\n") +
                                     "[[at]]\nt = 0.5\ndo = \"release\"\nid = \"s\"\n");
    World world(scene);
    for (const int ticks : {10, 30}) {
        run(world, ticks);
        World other(scene);
        other.restore(world.save());
        run(world, 5);
        run(other, 5);
        EXPECT_EQ(world.save(), other.save());
    }
    run(world, 50);
    EXPECT_EQ(world.joints().front().left, 0);
    EXPECT_GT(wayOf(world).across, 0.1);
}

// A box that is turned by 90° about y and moved: the same hinge, ball joint, weld, rod and spring, with the place in
// its axes and in the world's.
TEST(Places, InTheWorldAreThoseOfTheSide) {
    const std::string box =
        "[solid.box]\nshape = \"box\"\nsize = [0.2, 0.4, 0.6]\nposition = [1, 2, 3]\nrotation_deg = [0, 90, 0]\n"
        "[solid.other]\nshape = \"box\"\nsize = [0.2, 0.2, 0.2]\nposition = [1, 2.4, 3]\n"
        "[net.n]\npoints = [{ name = \"p\", position = [1.3, 2.2, 3.1] }, { name = \"q\", position = [2, 2.2, 3] }]\n"
        "hold = [\"q\"]\n";
    // Local (x, y, z) is (z, y, -x) in the world, from the box.
    const auto stateOf = [&](const std::string& joint, const std::string& own, const std::string& world) {
        World a(sceneOf("[0, -9.81, 0]", box + "[[joint]]\n" + joint + own)),
            b(sceneOf("[0, -9.81, 0]", box + "[[joint]]\n" + joint + world + "place_in = \"world\"\n"));
        run(a, 20);
        run(b, 20);
        double most = 0;
        for (const char* name : {"solid.box", "solid.other", "net.n"})
            for (std::size_t i = 0; i < a.points(name).x.size(); ++i)
                most = std::max(most, lengthOf(a.points(name).x[i] - b.points(name).x[i]));
        return most;
    };
    for (const std::string b : {"solid.other", "collider.post"})
        for (const char* kind : {"hinge", "ball", "slider"})
            EXPECT_LT(
                stateOf("a = \"solid.box\"\nb = \"" + b + "\"\nkind = \"" + kind + "\"\n",
                        "place = [-0.1, 0.2, 0.3]\naxis = [1, 0, 0]\n", "place = [1.3, 2.2, 3.1]\naxis = [0, 0, -1]\n"),
                1e-9)
                << b << kind;
    for (const char* kind : {"weld", "rod", "spring"})
        EXPECT_LT(stateOf("a = \"solid.box\"\nb = \"net.n@p\"\nkind = \"" + std::string(kind) + "\"\n",
                          "place = [-0.1, 0.2, 0.29]\n", "place = [1.29, 2.2, 3.1]\n"),
                  1e-9)
            << kind;
    // On a collider: the post is at (0, 2, 0).
    for (const char* kind : {"rod", "spring"})
        EXPECT_LT(stateOf("a = \"net.n@p\"\nb = \"collider.post\"\nkind = \"" + std::string(kind) + "\"\n",
                          "place = [0.5, 0.5, 0]\n", "place = [0.5, 2.5, 0]\n"),
                  1e-12)
            << kind;
}

}  // namespace
}  // namespace taut::world::sliders
