#include "taut/island/private/step_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/small_scenes.h"
#include "support/timelines.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/core/error.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

SceneSpec oneRope() {
    SceneSpec scene;
    scene.bodies.add(support::rope("a", {0, 0, 0}, {1, 0, 0}));
    scene.bodies.of<RopeSpec>()[0].source = {"s.toml", 5, 1};
    return scene;
}

// From h²Ω² + 4hτΩ² = 4: h = σ 2 (√(τ² + 1/Ω²) - τ).
TEST(StepChoice, AutoIsTheSafeShareOfTheLimitRoundedToWholeSubsteps) {
    const SceneSpec scene = oneRope();
    const IslandInfo island = World(scene).islands()[0];
    const double omega = island.omegaBound, tau = scene.bodies.of<RopeSpec>()[0].dampingTime;
    const double limit = 2.0 * (std::sqrt(tau * tau + 1.0 / (omega * omega)) - tau);
    EXPECT_NEAR(island.stepLimit, limit, 1e-12 * limit);
    EXPECT_EQ(island.substeps, static_cast<int>(std::ceil((1.0 / 60.0) / (0.9 * limit))));
    EXPECT_DOUBLE_EQ(island.step, 1.0 / 60.0 / island.substeps);
}

// B1 by hand: k = EA/ℓ = 1e5 N/m, inner masses 0.1 kg: S w = 2k/m for both ends of an inner spring.
TEST(StepChoice, TheBoundOfARopeIsTwiceTheRootOfKOverM) {
    const IslandInfo island = World(oneRope()).islands()[0];
    EXPECT_NEAR(island.omegaBound, 2.0 * std::sqrt(1e5 / 0.1), 1e-9);
    EXPECT_NE(island.limitingSpring.find("structural spring"), std::string::npos);
    EXPECT_NE(island.limitingSpring.find("of rope.a"), std::string::npos);
}

// With inner masses of 0.1 kg a straight chain has the bound 2√(k/m) for the present k, before any ramp.
TEST(StepChoice, TheBoundOfNowIsThatOfTheStateAsItIs) {
    SceneSpec scene = oneRope();
    scene.world.gravity = dvec3(0.0);
    scene.actions = {support::ramp(0.05, "rope.a.stretch", fields::Affects::springs, 4e4, 0.1, Ease::linear,
                                   [](SceneSpec& s) -> double& { return s.bodies.of<RopeSpec>()[0].stretch; })};
    World world(scene);
    const double now = world.islands()[0].omegaNow;
    EXPECT_NEAR(now, 2.0 * std::sqrt(1e5 / 0.1), 1.0);  // single precision
    support::run(world, 12);
    EXPECT_NEAR(world.islands()[0].omegaNow, 2.0 * now, 1.0);
    EXPECT_NEAR(world.islands()[0].omegaEstimate, 2.0 * now, 20.0);  // of a free chain the same
}

TEST(StepChoice, AStepByHandIsAMaximum) {
    SceneSpec scene = oneRope();
    scene.solver.dt = 1.0 / 60.0 / 1000.5;
    EXPECT_EQ(World(scene).islands()[0].substeps, 1001);
    scene.solver.dt = 1.0 / 60.0 / 1000.0;
    EXPECT_EQ(World(scene).islands()[0].substeps, 1000);
    EXPECT_TRUE(World(scene).warnings().empty());
}

TEST(StepChoice, AStepOverTheLimitIsReportedWithItsSpringBeforeTheFirstFrame) {
    SceneSpec scene = oneRope();
    scene.solver.dt = 1e-3;  // the limit is 2/2000 s without damping, less with it
    const World world(scene);
    ASSERT_EQ(world.warnings().size(), 1U);
    const std::string warning = printed(world.warnings()[0]);
    EXPECT_NE(warning.find("rope.a: the step of"), std::string::npos) << warning;
    EXPECT_NE(warning.find("over the stability limit of leap-frog"), std::string::npos) << warning;
    EXPECT_NE(warning.find("structural spring"), std::string::npos) << warning;
}

IslandInfo ropeDampedBy(double tau, Dashpots dashpots, const char* method = "leapfrog") {
    SceneSpec scene = oneRope();
    scene.bodies.of<RopeSpec>()[0].dampingTime = tau;
    scene.solver.dashpots = dashpots;
    scene.solver.integrator = method;
    return World(scene).islands()[0];
}

// Of Ω = 2000 /s leap-frog stands 1 ms undamped, 0.025 ms with τ = 10 ms and 0.82 ms with 0.1 ms; of that 0.9, in whole
// parts of a tick.
TEST(StepChoice, DampingThatSetsTheStepIsNamedWithTheStepThatLessWouldGive) {
    const IslandInfo island = ropeDampedBy(0.01, Dashpots::extrapolated);
    EXPECT_EQ(island.advice, std::vector<std::string>{"rope.a: damping_time_s = 0.01 sets the step of 2.25e-05 s: with "
                                                      "0.0001 it is 0.000725 s"});
    EXPECT_EQ(inSeconds(island.step), "2.25e-05 s");
    EXPECT_EQ(inSeconds(ropeDampedBy(1e-4, Dashpots::extrapolated).step), "0.000725 s");
}

// Split off, the dashpots of a chain are solved for at once, at any damping: the step is 0.98 · 0.9 of 1 ms.
TEST(StepChoice, DampingThatDoesNotSetTheStepIsNotNamed) {
    const IslandInfo split = ropeDampedBy(0.01, Dashpots::automatic);
    EXPECT_TRUE(split.splitsDashpots);
    EXPECT_TRUE(split.advice.empty()) << split.advice[0];
    EXPECT_EQ(split.substeps, static_cast<int>(std::ceil((1.0 / 60.0) / (0.98 * 0.9 * 1e-3))));
    EXPECT_TRUE(ropeDampedBy(1e-4, Dashpots::extrapolated).advice.empty());
    EXPECT_TRUE(ropeDampedBy(0.01, Dashpots::automatic, "implicit-euler").advice.empty());
}

// A square of four triangles about its middle, which a second vertex as near as `gap` [m] makes six.
SceneSpec meshWithGap(double gap) {
    auto mesh = std::make_shared<MeshData>();
    mesh->positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.5 + gap, 0.5, 0}};
    mesh->triangles = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 3, 4}, {2, 4, 5}, {3, 0, 4}};
    mesh->numbers = {11, 12, 13, 14, 15, 16};
    ClothSpec cloth;
    cloth.name = "c";
    cloth.mesh = "shirt.obj";
    cloth.meshData = mesh;
    SceneSpec scene;
    scene.bodies.add(cloth);
    return scene;
}

TEST(StepChoice, ASliverEdgeThatSetsTheStepIsNamed) {
    const IslandInfo island = World(meshWithGap(1e-3)).islands()[0];
    ASSERT_FALSE(island.advice.empty());
    EXPECT_EQ(island.advice[0],
              "cloth.c: the edge between vertices 15 and 16 of shirt.obj is 1 mm long, the median 0.71 m, and sets the "
              "step: merge by distance, or integrator = \"implicit-euler\"");
    const IslandInfo even = World(meshWithGap(0.3)).islands()[0];
    for (const std::string& advice : even.advice) EXPECT_EQ(advice.find("edge"), std::string::npos) << advice;
}

TEST(StepChoice, ExplicitEulerWithoutDampingHasNoAutomaticStep) {
    SceneSpec scene = oneRope();
    scene.bodies.of<RopeSpec>()[0].dampingTime = 0.0;
    scene.bodies.of<RopeSpec>()[0].drag = 0.0;
    scene.solver.integrator = "euler";
    try {
        const World world(scene);
        FAIL();
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        EXPECT_EQ(std::string(error.what()).find("s.toml:5:1: error: rope.a: dt = \"auto\" finds no step"), 0U)
            << error.what();
    }
    scene.bodies.of<RopeSpec>()[0].dampingTime = 1e-4;
    EXPECT_NEAR(World(scene).islands()[0].stepLimit, 1e-4, 1e-9);  // 2ζ/ω = τ for ζ < 1
}

TEST(StepChoice, AnAbsurdlyStiffBodyIsRefusedInsteadOfRunForEver) {
    SceneSpec scene = oneRope();
    scene.bodies.of<RopeSpec>()[0].stretch = 1e18;
    EXPECT_THROW(World{scene}, core::Error);
}

}  // namespace
}  // namespace taut::world
