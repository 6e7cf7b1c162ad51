// Bodies reported to come into each other's way, and other bodies.
#include "taut/advice/private/encounters.h"

#include <gtest/gtest.h>

#include "support/timelines.h"

namespace taut::world {
namespace {

using support::action;
using Pairs = std::set<std::pair<std::string, std::string>>;

// A cube of 0.4 m.
BlockSpec cube(const std::string& name, dvec3 place) {
    BlockSpec spec;
    spec.name = name;
    spec.size = {0.4, 0.4, 0.4};
    spec.cells = {2, 2, 2};
    spec.position = place;
    return spec;
}

SceneSpec sceneOf(const std::vector<BlockSpec>& cubes) {
    SceneSpec scene;
    scene.run.seconds = 1;
    for (const BlockSpec& spec : cubes) scene.bodies.add(spec);
    return scene;
}

// Held at both ends, 1 m above the ground.
RopeSpec line() {
    RopeSpec rope = support::rope("line", {-1, 1, 0}, {1, 1, 0}, 20);
    rope.hold = {"start", "end"};
    return rope;
}

TEST(Encounters, AreOfABodyThatFallsOntoOneThatIsHeld) {
    SceneSpec scene = sceneOf({cube("ball", {0, 3, 0})});
    scene.bodies.add(line());
    EXPECT_EQ(encounters(scene).pairs, (Pairs{{"block.ball", "rope.line"}}));
    scene.run.seconds = 0.5;  // 1.2 m of a way of 1.8 m
    EXPECT_EQ(encounters(scene).pairs, Pairs());
    scene.run.seconds = 1;
    scene.bodies.of<BlockSpec>()[0].position.z = 0.5;  // 0.3 m beside
    EXPECT_EQ(encounters(scene).pairs, Pairs());
    scene.bodies.of<BlockSpec>()[0].velocity = {0, 0, -0.78};  // 0.64 s from there
    EXPECT_EQ(encounters(scene).pairs.size(), 1U);
}

TEST(Encounters, EndWhereAColliderStopsTheFall) {
    SceneSpec scene = sceneOf({cube("ball", {0, 3, 0})});
    scene.bodies.add(line());
    ColliderSpec table;
    table.shape = "box";
    table.size = {1, 0.1, 1};
    table.position = {0, 1.5, 0};
    scene.colliders = {table};
    EXPECT_EQ(encounters(scene).pairs, Pairs());
}

// The lower one lies on a ball by the time that the upper one comes.
TEST(Encounters, AreOfAClothThatFallsOntoAnotherOnACollider) {
    SceneSpec scene;
    scene.run.seconds = 1;
    for (const auto& [name, height] : {std::pair{"lower", 1.05}, std::pair{"upper", 1.3}}) {
        ClothSpec cloth = support::cloth(name, 4);
        cloth.origin = {-0.5, height, -0.5};
        cloth.down = {0, 0, 1};
        scene.bodies.add(cloth);
    }
    EXPECT_EQ(encounters(scene).pairs, Pairs());  // they fall side by side
    scene.colliders = {support::ball("ball", {0, 0.7, 0}, 0.3)};
    EXPECT_EQ(encounters(scene).pairs, (Pairs{{"cloth.lower", "cloth.upper"}}));
    for (BodySpec& body : scene.bodies) body.touch = Touch::others;
    EXPECT_EQ(encounters(scene).pairs, Pairs());  // of each other they do not go through
}

// A pendulum of 0.5 m that starts level hangs after a quarter of its swing, about 0.42 s.
TEST(Encounters, AreOfWhatSwingsIntoAnother) {
    SceneSpec scene;
    scene.run.seconds = 0.6;
    RopeSpec pendulum = support::rope("pendulum", {0, 2, 0}, {0.5, 2, 0}, 4);
    pendulum.hold = {"start"};
    scene.bodies.add(pendulum);
    RopeSpec bar = support::rope("bar", {-0.1, 1.6, -0.5}, {-0.1, 1.6, 0.5}, 4);
    bar.hold = {"start", "end"};
    scene.bodies.add(bar);
    EXPECT_EQ(encounters(scene).pairs, (Pairs{{"rope.bar", "rope.pendulum"}}));
    scene.run.seconds = 0.3;
    EXPECT_EQ(encounters(scene).pairs, Pairs());
}

TEST(Encounters, AreNotOfBodiesThatAreTied) {
    SceneSpec scene = sceneOf({cube("lower", {0, 1, 0}), cube("upper", {0, 1.3, 0})});
    EXPECT_EQ(encounters(scene).pairs.size(), 1U);  // one stands 0.1 m in the other
    scene.joints = {support::springJoint("block.lower@top", "block.upper@bottom", 1e3, 0)};
    EXPECT_EQ(encounters(scene).pairs, Pairs());
}

TEST(Encounters, CountFromTheSpawnOfABody) {
    SceneSpec scene = sceneOf({cube("lower", {0, 0.21, 0}), cube("upper", {0, 0.7, 0})});
    scene.colliders = {support::ground()};
    scene.actions = {action<SpawnAction>(0.5, "block.upper")};
    EXPECT_EQ(encounters(scene).pairs, (Pairs{{"block.lower", "block.upper"}}));
    scene.actions = {action<SpawnAction>(0.95, "block.upper")};
    EXPECT_EQ(encounters(scene).pairs, Pairs());
}

// The diagonals of its cells are 0.28 m long.
TEST(Encounters, AreOfAPostBetweenThePointsOfACloth) {
    SceneSpec scene;
    scene.run.seconds = 1;
    ClothSpec cloth = support::cloth("sheet", 6);
    cloth.size = {1.2, 1.2};
    cloth.origin = {-0.7, 0.6, -0.67};
    cloth.down = {0, 0, 1};
    scene.bodies.add(cloth);
    ColliderSpec post;
    post.name = "post";
    post.shape = "box";
    post.size = {0.12, 0.4, 0.12};
    post.position = {0, 0.2, 0};
    scene.colliders = {post, support::ground()};
    using Posts = std::map<std::pair<std::string, std::string>, double>;
    EXPECT_EQ(encounters(scene).posts, (Posts{{{"cloth.sheet", "collider.post"}, 0.12}}));
    scene.colliders[0].position.x = 3;  // beside
    EXPECT_EQ(encounters(scene).posts, Posts());
    scene.colliders[0].position.x = 0;
    scene.colliders[0].size = {0.3, 0.4, 0.3};
    EXPECT_EQ(encounters(scene).posts, Posts());
    scene.colliders[0].size = {0.12, 0.4, 0.12};
    scene.bodies[0].meetsFaces = true;
    EXPECT_EQ(encounters(scene).posts, Posts());
}

TEST(Encounters, AreLookedForAsFarAsIsCheap) {
    SceneSpec scene;
    scene.run.seconds = 1e5;
    for (const char* name : {"a", "b"})
        scene.bodies.add(support::rope(name, {0, 2, 0.1 * name[0]}, {1, 2, 0.1 * name[0]}));
    const double seen = encounters(scene, 1e6).seen;
    EXPECT_GT(seen, 0);
    EXPECT_LT(seen, 10);  // a tick of 22 points counts 80 ns a point at least
    EXPECT_GT(encounters(scene, 2e6).seen, 1.5 * seen);
}

}  // namespace
}  // namespace taut::world
