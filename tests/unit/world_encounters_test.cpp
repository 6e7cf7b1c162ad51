// Which bodies are said to come into each other's way, and which are not.
#include "taut/world/encounters.h"

#include <gtest/gtest.h>

#include "support/timelines.h"

namespace taut::world {
namespace {

using support::action;
using Pairs = std::vector<std::pair<std::string, std::string>>;

// A cube of 0.4 m.
BlockSpec cube(const std::string& name, dvec3 place) {
    BlockSpec spec;
    spec.name = name;
    spec.size = {0.4, 0.4, 0.4};
    spec.cells = {4, 4, 4};
    spec.position = place;
    return spec;
}

SceneSpec sceneOf(const std::vector<BlockSpec>& cubes) {
    SceneSpec scene;
    scene.run.seconds = 2;
    for (const BlockSpec& spec : cubes) scene.bodies.add(spec);
    return scene;
}

Pairs pairsOf(const SceneSpec& scene) {
    World world(scene);
    return encounters(world);
}

TEST(Encounters, AreOfABodyThatFallsOntoOneThatIsHeld) {
    SceneSpec scene = sceneOf({cube("ball", {0, 3, 0})});
    scene.bodies.add(support::rope("line", {-1, 1, 0}, {1, 1, 0}, 20));
    scene.bodies.of<RopeSpec>()[0].hold = {"start", "end"};
    EXPECT_EQ(pairsOf(scene), (Pairs{{"block.ball", "rope.line"}}));
    scene.run.seconds = 0.5;  // 1.2 m of a way of 1.8 m
    EXPECT_EQ(pairsOf(scene), Pairs());
    scene.run.seconds = 2;
    scene.bodies.of<BlockSpec>()[0].position.z = 0.5;  // 0.3 m beside
    EXPECT_EQ(pairsOf(scene), Pairs());
    scene.bodies.of<BlockSpec>()[0].velocity = {0, 0, -0.78};  // 0.64 s from there
    EXPECT_EQ(pairsOf(scene).size(), 1U);
}

TEST(Encounters, EndWhereAColliderStopsTheFall) {
    SceneSpec scene = sceneOf({cube("ball", {0, 3, 0})});
    scene.bodies.add(support::rope("line", {-1, 1, 0}, {1, 1, 0}, 20));
    scene.bodies.of<RopeSpec>()[0].hold = {"start", "end"};
    scene.colliders = {support::ground()};
    scene.colliders[0].position = {0, 1.5, 0};
    EXPECT_EQ(pairsOf(scene), Pairs());
}

TEST(Encounters, AreOfAPileOnTheGroundButNotOfWhatFallsSideBySide) {
    SceneSpec scene = sceneOf({cube("lower", {0, 1, 0}), cube("upper", {0, 1.6, 0}), cube("aside", {0.5, 1, 0})});
    EXPECT_EQ(pairsOf(scene), Pairs());  // all at the same speed
    scene.colliders = {support::ground()};
    EXPECT_EQ(pairsOf(scene), (Pairs{{"block.lower", "block.upper"}}));
}

TEST(Encounters, AreNotOfBodiesThatAreTied) {
    SceneSpec scene = sceneOf({cube("lower", {0, 1, 0}), cube("upper", {0, 1.3, 0})});
    EXPECT_EQ(pairsOf(scene).size(), 1U);  // one stands 0.1 m in the other
    scene.joints = {{"block.lower@top", "block.upper@bottom", JointSpec::Kind::spring, 1e3, 0, 0, {}}};
    EXPECT_EQ(pairsOf(scene), Pairs());
}

TEST(Encounters, CountFromTheSpawnOfABody) {
    SceneSpec scene = sceneOf({cube("lower", {0, 0.2, 0}), cube("upper", {0, 1, 0})});
    scene.colliders = {support::ground()};
    scene.actions = {action<SpawnAction>(1.0, "block.upper")};
    EXPECT_EQ(pairsOf(scene), (Pairs{{"block.lower", "block.upper"}}));
    scene.actions = {action<SpawnAction>(1.9, "block.upper")};
    EXPECT_EQ(pairsOf(scene), Pairs());
}

}  // namespace
}  // namespace taut::world
