// Points that begin inside a collider: reported with names and depth, and out at a walk.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/timelines.h"

namespace taut::world {
namespace {

using support::action;

double fastest(const World& world, const std::string& target) {
    double most = 0;
    for (const dvec3& v : world.points(target).v) most = std::max(most, glm::length(v));
    return most;
}
double lowest(const World& world, const std::string& target) {
    double y = HUGE_VAL;
    for (const dvec3& x : world.points(target).x) y = std::min(y, x.y);
    return y;
}

// A soft cube of 0.4 m that stands 0.3 m deep in the ground.
SceneSpec sunkCube() {
    SceneSpec scene;
    scene.run.seconds = 2;
    BlockSpec cube;
    cube.name = "cube";
    cube.size = {0.4, 0.4, 0.4};
    cube.cells = {4, 4, 4};
    cube.position = {0, -0.1, 0};
    scene.bodies.add(cube);
    scene.colliders = {support::ground()};
    return scene;
}

TEST(Inside, IsSaidWithNamesNumberAndDepth) {
    const std::vector<std::string> warnings = printed(World(sunkCube()).warnings());
    ASSERT_EQ(warnings.size(), 1U);
    // Three of five layers of 25 points: the fourth is on the ground.
    EXPECT_EQ(warnings[0],
              "block.cube: 75 of its points start inside collider.ground, up to 0.3 m deep; they come out at 1 m/s: "
              "move the body or the collider");
    SceneSpec above = sunkCube();
    above.bodies.of<BlockSpec>()[0].position = {0, 0.2, 0};  // its lowest points on the ground
    EXPECT_TRUE(World(above).warnings().empty());
    SceneSpec through = sunkCube();
    through.bodies[0].collide = false;
    EXPECT_TRUE(World(through).warnings().empty());
}

TEST(Inside, PointsComeOutNoFasterThanAWalk) {
    World world(sunkCube());
    double most = 0;
    for (int i = 0; i < 60; ++i) {
        support::run(world, 1);
        most = std::max(most, fastest(world, "block.cube"));
        EXPECT_LE(lowest(world, "block.cube"), -0.3 + (i + 1) / 60.0 + 1e-5);  // no further than 1 m/s takes it
    }
    EXPECT_LT(most, 2.5);  // by its springs; shot out it would have 13 m/s
    EXPECT_GE(lowest(world, "block.cube"), -1e-6);
}

TEST(Inside, ARestoredWorldGoesOnTheSameWay) {
    World original(sunkCube());
    support::run(original, 8);
    World restored(sunkCube());
    restored.restore(original.save());
    EXPECT_EQ(restored.warnings(), original.warnings());
    support::run(original, 30);
    support::run(restored, 30);
    EXPECT_EQ(restored.stateHash(), original.stateHash());
    // Once all are out nothing is left of it.
    World late(sunkCube());
    support::run(original, 60);
    late.restore(original.save());
    support::run(original, 10);
    support::run(late, 10);
    EXPECT_EQ(late.stateHash(), original.stateHash());
}

TEST(Inside, CountsFromTheSpawnOfABody) {
    SceneSpec scene = sunkCube();
    scene.actions = {action<SpawnAction>(0.2, "block.cube")};
    World world(scene);
    EXPECT_TRUE(world.warnings().empty());
    double most = 0;
    for (int i = 0; i < 60; ++i) {
        support::run(world, 1);
        most = std::max(most, fastest(world, "block.cube"));
    }
    EXPECT_LT(most, 2.5);
    EXPECT_EQ(world.warnings().size(), 1U);
}

TEST(Inside, PointsThatAreHeldThereAreFreedAtAWalkToo) {
    SceneSpec scene = sunkCube();
    scene.bodies[0].hold = {"all"};
    scene.actions = {action<FreeAction>(0.2, "block.cube")};
    World world(scene);
    EXPECT_TRUE(world.warnings().empty());
    double most = 0;
    for (int i = 0; i < 60; ++i) {
        support::run(world, 1);
        most = std::max(most, fastest(world, "block.cube"));
    }
    EXPECT_LT(most, 2.5);
    EXPECT_GE(lowest(world, "block.cube"), -1e-6);
}

}  // namespace
}  // namespace taut::world
