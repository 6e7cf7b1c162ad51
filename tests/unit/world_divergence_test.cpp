#include <gtest/gtest.h>

#include <cmath>

#include "support/small_scenes.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/forces/wind.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

SceneSpec tooLongAStep() {
    SceneSpec scene;
    ClothSpec spec = support::cloth("flag", 12);
    spec.hold = {"left"};
    spec.jitter = 1e-3;
    scene.bodies.add(spec);
    scene.solver.dt = 1.0 / 240.0;  // several times the limit
    return scene;
}

TEST(Divergence, StopsTheRunAndKeepsTheLastGoodState) {
    World world(tooLongAStep());
    std::optional<Divergence> divergence;
    int ticks = 0;
    for (; ticks < 600 && !divergence; ++ticks) divergence = world.advance();
    ASSERT_TRUE(divergence);
    EXPECT_EQ(world.tick(), ticks - 1);  // the failed tick does not count
    world.registry().each<BodyPart>([&](ecs::Entity entity, const BodyPart&) {
        for (const dvec3& x : world.positions(entity))
            EXPECT_TRUE(std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z));
    });
}

TEST(Divergence, PutsEveryIslandBackToTheSameTick) {
    SceneSpec scene = tooLongAStep();
    scene.bodies.add(support::rope("calm", {5, 3, 0}, {6, 3, 0}, 4));
    scene.bodies.of<RopeSpec>()[0].solver.dt = 1e-4;
    World world(scene);
    const auto heightOfRope = [&] {
        double y = 0;
        world.registry().each<Identity, BodyPart>([&](ecs::Entity entity, const Identity& identity, const BodyPart&) {
            if (identity.kind == "rope") y = world.positions(entity)[0].y;
        });
        return y;
    };
    double before = heightOfRope();
    while (!world.advance()) before = heightOfRope();
    EXPECT_EQ(heightOfRope(), before);
}

TEST(Divergence, SaysWhatWhereAndWhatWouldHold) {
    World world(tooLongAStep());
    std::optional<Divergence> divergence;
    for (int i = 0; i < 600 && !divergence; ++i) divergence = world.advance();
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->body, "cloth.flag");
    EXPECT_GE(divergence->point, 0);
    EXPECT_NE(divergence->spring.find("of cloth.flag"), std::string::npos);
    EXPECT_GT(divergence->omegaH, divergence->limit);
    EXPECT_NEAR(divergence->safeStep, world.islands()[0].stepLimit, 1e-15);
    for (const char* word : {"diverged at t =", "ω h =", "remedy: dt =", "velocity Verlet would need",
                             "implicit Euler stands every step", "integrator = \"implicit-euler\""})
        EXPECT_NE(divergence->message.find(word), std::string::npos) << word << " in " << divergence->message;
}

TEST(Divergence, TheSafeStepItNamesHolds) {
    World failing(tooLongAStep());
    std::optional<Divergence> divergence;
    for (int i = 0; i < 600 && !divergence; ++i) divergence = failing.advance();
    ASSERT_TRUE(divergence);
    SceneSpec scene = tooLongAStep();
    scene.solver.dt = divergence->safeStep;
    World world(scene);
    for (int i = 0; i < 300; ++i) ASSERT_FALSE(world.advance()) << i;
}

// A wind whose force leaves the range of single precision.
TEST(Divergence, ANumberThatIsNoneNamesItsPoint) {
    SceneSpec scene;
    scene.bodies.add(support::rope("a", {0, 3, 0}, {1, 3, 0}, 4));
    WindSpec wind;
    wind.name = "storm";
    wind.velocity = {1e30, 0.0, 0.0};
    ClothSpec cloth = support::cloth("sail", 4);
    scene.bodies.add(cloth);
    scene.forces.add(wind);
    scene.solver.dt = 1e-3;
    World world(scene);
    const std::optional<Divergence> divergence = world.advance();
    ASSERT_TRUE(divergence);
    EXPECT_EQ(divergence->body, "cloth.sail");
    EXPECT_EQ(world.tick(), 0);
    EXPECT_LT(divergence->time, 0.002);  // within a step or two of the storm
}

}  // namespace
}  // namespace taut::world
