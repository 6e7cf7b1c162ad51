// Strain limits: nothing is stretched further, momentum stays, energy is only lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "support/timelines.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/bodies/rope.h"
#include "taut/world/world.h"

namespace taut::world::strain_limit {
namespace {

using support::run;

// A scarf of 5 columns and a rope, held at their tops, that move downwards when they stop. In the scarf a wave goes at
// √(900 N/m / 0.2 kg/m²) = 67 m/s, behind which it is strained by speed/67: by 9 % at 6 m/s; the rope is as stiff.
SceneSpec stopped(std::optional<double> limit, const std::string& method = "leapfrog", double speed = 6) {
    SceneSpec scene;
    scene.solver.integrator = method;
    scene.world.gravity = dvec3(0.0);
    MaterialSpec& wool = scene.materials["wool"];
    wool.density = 0.2;
    wool.stretch = 900;
    wool.drag = 0;
    wool.plasticity.strainLimit = limit;
    ClothSpec scarf = support::cloth("scarf");
    scarf.size = {0.2, 1.2};
    scarf.cells = {4, 24};
    scarf.material = "wool";
    scarf.hold = {"top"};
    scarf.velocity = {0, -speed, 0};
    scene.bodies.add(scarf);
    RopeSpec rope = support::rope("rope", {1, 2, 0}, {1, 0.8, 0}, 24);
    rope.mass = 0.048;
    rope.stretch = 180;
    rope.drag = 0;
    rope.plasticity.strainLimit = limit;
    rope.hold = {"start"};
    rope.velocity = scarf.velocity;
    scene.bodies.add(rope);
    return scene;
}

// (l - L)/L, the largest of lines along the columns of 0.05 m.
double stretchOf(const World& world, const std::string& body, std::size_t columns) {
    const std::vector<dvec3> x = world.points(body).x;
    double most = 0;
    for (std::size_t i = 0; i + columns < x.size(); ++i)
        most = std::max(most, glm::length(x[i + columns] - x[i]) / 0.05 - 1);
    return most;
}

struct Stretches {
    double scarf = 0, rope = 0;
};

Stretches largest(const SceneSpec& scene) {
    World world(scene);
    Stretches most;
    const double start = world.metrics().energy();
    double energy = start;
    for (int tick = 0; tick < 60; ++tick) {
        run(world, 1);
        most.scarf = std::max(most.scarf, stretchOf(world, "cloth.scarf", 5));
        most.rope = std::max(most.rope, stretchOf(world, "rope.rope", 1));
        const double now = world.metrics().energy();
        EXPECT_LT(now, energy + 0.005 * start) << tick;  // the method's own error
        energy = std::min(energy, now);
    }
    return most;
}

TEST(StrainLimit, NothingIsStretchedFurther) {
    const Stretches free = largest(stopped({}));
    EXPECT_GT(free.scarf, 0.08);
    EXPECT_GT(free.rope, 0.08);
    for (const char* method : {"leapfrog", "velocity-verlet", "rk4", "implicit-euler"}) {
        const Stretches limited = largest(stopped(0.05, method));
        EXPECT_LE(limited.scarf, 0.05) << method;
        EXPECT_LE(limited.rope, 0.05) << method;
        EXPECT_GT(limited.scarf, 0.04) << method;
        EXPECT_GT(limited.rope, 0.04) << method;
    }
}

// At 200 m/s a point passes 2 cells in a step of "auto", at 75 m/s one in two steps; the front that stops the rope is
// 20 times as fast.
TEST(StrainLimit, HoldsAtAnySpeed) {
    for (const double speed : {20.0, 75.0, 200.0}) {
        const Stretches limited = largest(stopped(0.05, "leapfrog", speed));
        EXPECT_LE(limited.scarf, 0.05) << speed;
        EXPECT_LE(limited.rope, 0.05) << speed;
    }
}

// A sheet that spins in its plane at 120 rad/s strains by some 6 %.
TEST(StrainLimit, KeepsMomentumAndTakesEnergy) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.world.gravity = dvec3(0.0);
    scene.materials["wool"].drag = 0;
    scene.materials["wool"].dampingTime = 0;
    ClothSpec sheet = support::cloth("sheet");
    sheet.size = {0.4, 0.4};
    sheet.material = "wool";
    sheet.spin = {0, 0, 120};
    sheet.velocity = {1, 2, 3};
    scene.bodies.add(sheet);
    const auto momenta = [](const World& world) {
        const PointsNow now = world.points("cloth.sheet");
        std::array<dvec3, 2> sum{dvec3(0.0), dvec3(0.0)};
        for (std::size_t i = 0; i < now.x.size(); ++i) {
            sum[0] += now.mass[i] * now.v[i];
            sum[1] += now.mass[i] * glm::cross(now.x[i], now.v[i]);
        }
        return sum;
    };
    for (const std::optional<double> limit : {std::optional<double>(), std::optional(0.02)}) {
        scene.materials["wool"].plasticity.strainLimit = limit;
        World world(scene);
        const auto before = momenta(world);
        const double energy = world.metrics().energy();
        run(world, 30);
        const auto after = momenta(world);
        // Sums of 81 points, over some 1000 steps.
        EXPECT_NEAR(glm::length(after[0] - before[0]), 0, 1e-11 * glm::length(before[0]));
        EXPECT_NEAR(glm::length(after[1] - before[1]), 0, 1e-9 * glm::length(before[1]));
        const double lost = 1 - world.metrics().energy() / energy;
        if (limit)
            EXPECT_GT(lost, 1e-3);
        else
            EXPECT_NEAR(lost, 0, 1e-3);
    }
}

TEST(StrainLimit, ARestoredRunGoesOnTheSame) {
    SceneSpec scene = stopped(0.05);
    scene.materials["wool"].plasticity.breakStrain = 0.045;  // tears, so that links go
    World world(scene);
    for (int tick = 0; tick < 12; ++tick) {
        World other(scene);
        other.restore(world.save());
        run(world, 1);
        run(other, 1);
        ASSERT_EQ(other.stateHash(), world.stateHash()) << tick;
    }
    EXPECT_GT(world.metrics().brokenSprings, 0);
}

}  // namespace
}  // namespace taut::world::strain_limit
