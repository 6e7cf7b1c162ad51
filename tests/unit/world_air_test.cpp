// The air that a cloth takes along in a wind: inertia without weight.
#include <gtest/gtest.h>

#include "support/timelines.h"
#include "taut/bodies/cloth.h"
#include "taut/forces/wind.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

// A level sheet of 0.1 kg/m² with 0.05 kg/m² of air falls; the wind, if there is one, resists nothing.
SceneSpec falling(bool hasWind) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    MaterialSpec& sheet = scene.materials["sheet"];
    sheet.density = 0.1;
    sheet.air = 0.05;
    sheet.drag = 0.0;
    ClothSpec cloth;
    cloth.name = "sheet";
    cloth.material = "sheet";
    cloth.size = {0.4, 0.3};
    cloth.cells = {4, 3};
    cloth.down = {0, 0, 1};
    scene.bodies.add(cloth);
    WindSpec wind;
    wind.name = "still";
    wind.drag = wind.lift = 0.0;
    if (hasWind) scene.forces.add(wind);
    return scene;
}

TEST(Air, GoesAlongInAWindAndWeighsNothing) {
    for (const bool hasWind : {true, false}) {
        World world(falling(hasWind));
        support::run(world, 30);
        const double acceleration = -9.81 * (hasWind ? 0.1 / 0.15 : 1.0);
        const double t = 30 * world.tickSeconds(), mass = (hasWind ? 0.15 : 0.1) * 0.12;
        const Metrics metrics = world.metrics();
        EXPECT_NEAR(metrics.momentum.y, mass * acceleration * t, 1e-12);
        EXPECT_NEAR(metrics.kinetic, 0.5 * mass * acceleration * acceleration * t * t, 1e-12);
        EXPECT_NEAR(metrics.elastic, 0.0, 1e-12);
        EXPECT_NEAR(metrics.kinetic + metrics.gravitational, 0.0, 1e-11);
        EXPECT_NEAR(world.islands().front().mass, 0.012, 1e-15);
    }
}

}  // namespace
}  // namespace taut::world
