#include <gtest/gtest.h>

#include <cmath>

#include "support/small_scenes.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/core/error.h"
#include "taut/plan/island_plan.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

SceneSpec twoRopes() {
    SceneSpec scene;
    scene.bodies.add(support::rope("a", {0, 0, 0}, {1, 0, 0}), support::rope("b", {1, 0, 0}, {2, 0, 0}));
    return scene;
}

TEST(Islands, BodiesThatNothingCouplesAreApart) {
    const World world(twoRopes());
    EXPECT_EQ(world.islands().size(), 2U);
}

TEST(Islands, AWeldMakesOnePointOfTwo) {
    SceneSpec scene = twoRopes();
    scene.joints = {support::weld("rope.a@end", "rope.b@start", 0.01)};
    const std::vector<IslandInfo> islands = World(scene).islands();
    ASSERT_EQ(islands.size(), 1U);
    EXPECT_EQ(islands[0].points, 21);  // 11 + 11 - 1
    EXPECT_EQ(islands[0].springs, 20);
    EXPECT_NEAR(islands[0].mass, 2.0, 1e-14);
}

TEST(Islands, AJointSaysWhatItTiesAndWarnsOfBodiesThatItNamesAndDoesNot) {
    SceneSpec scene = twoRopes();
    scene.bodies.add(support::rope("c", {1, 0, 0.3}, {2, 0, 0.3}), support::rope("d", {5, 0, 0}, {6, 0, 0}));
    scene.joints = {support::weld("rope.a@end", "rope.*@start", 0.01, {"s.toml", 3, 1})};
    const World world(scene);
    const std::vector<JointInfo> joints = world.joints();
    ASSERT_EQ(joints.size(), 1U);
    ASSERT_EQ(joints[0].pairs.size(), 1U);
    EXPECT_EQ(joints[0].pairs[0].a, "rope.a");
    EXPECT_EQ(joints[0].pairs[0].b, "rope.b");
    EXPECT_EQ(joints[0].pairs[0].points, 1);
    EXPECT_EQ(joints[0].loose, (std::vector<std::string>{"rope.c", "rope.d"}));
    ASSERT_EQ(world.warnings().size(), 1U);
    EXPECT_EQ(printed(world.warnings()[0]),
              "s.toml:3:1: warning: the joint \"rope.a@end\" – \"rope.*@start\" does not tie rope.c (0.3 m off), "
              "rope.d (4 m off); it reaches 0.01 m: move them together, raise reach_m, or use kind = \"spring\"");
    scene.joints = {support::weld("rope.a@end", "rope.b@start", 0.01)};
    EXPECT_TRUE(World(scene).warnings().empty());
}

TEST(Islands, AWeldAddsMassesAndKeepsMomentum) {
    SceneSpec scene = twoRopes();
    scene.bodies.of<RopeSpec>()[1].velocity = {0, 0, 2};
    scene.joints = {support::weld("rope.a@end", "rope.b@start", 0.01)};
    std::vector<Body> bodies = buildBodies(scene);
    const std::vector<IslandPlan> plans = planIslands(pointersTo(bodies), scene);
    const int welded = bodies[0].pointOf.back();
    EXPECT_EQ(welded, bodies[1].pointOf.front());
    const auto& point = plans[0].points[welded];
    EXPECT_NEAR(point.mass, 0.1, 1e-15);  // twice half a segment of a tenth of a kilogram
    EXPECT_NEAR(plans[0].velocities[welded].z, 1.0, 1e-15);
}

TEST(Islands, ASpringJointKeepsItsStartingLength) {
    SceneSpec scene = twoRopes();
    scene.bodies.of<RopeSpec>()[1].start.x = 1.5;
    scene.joints = {support::springJoint("rope.a@end", "rope.b@start", 500, 1e-3)};
    std::vector<Body> bodies = buildBodies(scene);
    const std::vector<IslandPlan> plans = planIslands(pointersTo(bodies), scene);
    ASSERT_EQ(plans.size(), 1U);
    const mechanics::Spring& joint = plans[0].springs.back();
    EXPECT_EQ(joint.kind, mechanics::SpringKind::joint);
    EXPECT_DOUBLE_EQ(joint.restLength, 0.5);
    EXPECT_EQ(joint.stiffness, 500.0);
}

TEST(Islands, AJointThatJoinsNothingSaysHowFarItIs) {
    SceneSpec scene = twoRopes();
    scene.bodies.of<RopeSpec>()[1].start.x = 1.5;
    scene.joints = {support::weld("rope.a@end", "rope.b@start", 0.01, {"s.toml", 9, 1})};
    try {
        const World world(scene);
        FAIL();
    } catch (const core::Error& error) {
        EXPECT_NE(std::string(error.what()).find("s.toml:9:1: error: the joint"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("0.5"), std::string::npos) << error.what();
    }
}

TEST(Islands, JoinedBodiesMustAgreeOnTheirSolver) {
    SceneSpec scene = twoRopes();
    scene.bodies.of<RopeSpec>()[1].solver.integrator = "velocity-verlet";
    EXPECT_EQ(World(scene).islands()[1].method, "velocity-verlet");
    scene.joints = {support::weld("rope.a@end", "rope.b@start", 0.01)};
    EXPECT_THROW(World{scene}, core::Error);
}

TEST(Islands, EachChoosesItsOwnNumberOfSubsteps) {
    SceneSpec scene = twoRopes();
    for (RopeSpec& rope : scene.bodies.of<RopeSpec>()) rope.dampingTime = 0.0;
    scene.bodies.of<RopeSpec>()[1].stretch = 1e6;
    const std::vector<IslandInfo> islands = World(scene).islands();
    EXPECT_EQ(islands[0].name, "rope.a");
    // ω grows with the root of the stiffness, a hundred times higher; whole substeps round by at most one.
    EXPECT_NEAR(islands[1].substeps, 10 * islands[0].substeps, 10);
}

TEST(Islands, MeshPointsAreNumberedForLocality) {
    // A strip of triangles whose vertices come in a shuffled order.
    SceneSpec scene;
    ClothSpec spec;
    spec.name = "strip";
    auto mesh = std::make_shared<MeshData>();
    const int columns = 200;
    const auto number = [&](int column, int row) { return (2 * column + row) * 7 % (2 * columns); };
    mesh->positions.resize(2 * columns);
    for (int c = 0; c < columns; ++c)
        for (int r = 0; r < 2; ++r) mesh->positions[number(c, r)] = {0.1 * c, 0.1 * r, 0.0};
    for (int c = 0; c + 1 < columns; ++c) {
        mesh->triangles.push_back({number(c, 0), number(c + 1, 0), number(c, 1)});
        mesh->triangles.push_back({number(c + 1, 0), number(c + 1, 1), number(c, 1)});
    }
    spec.mesh = "strip.obj";
    spec.meshData = mesh;
    scene.bodies.add(spec);
    std::vector<Body> bodies = buildBodies(scene);
    const std::vector<IslandPlan> plans = planIslands(pointersTo(bodies), scene);
    int farthest = 0;
    for (const mechanics::Spring& s : plans[0].springs) farthest = std::max(farthest, std::abs(s.a - s.b));
    // Two points a column, springs span at most two columns; breadth-first order adds a level more.
    EXPECT_LE(farthest, 8);
}

}  // namespace
}  // namespace taut::world
