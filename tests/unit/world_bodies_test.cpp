#include "taut/body/body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/small_scenes.h"
#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/core/error.h"

namespace taut::world {
namespace {

double massOf(const Body& body) {
    return std::accumulate(body.model.masses.begin(), body.model.masses.end(), 0.0);
}

TEST(Bodies, AnArrayMakesNumberedCopiesInAGrid) {
    SceneSpec scene;
    ClothSpec spec = support::cloth("row");
    spec.array.count = {3, 1, 4};
    spec.array.stepX = {2.0, 0.0, 0.0};
    spec.array.stepZ = {0.0, 0.5, -1.0};
    scene.bodies.add(spec);
    const std::vector<Body> bodies = buildBodies(scene);
    ASSERT_EQ(bodies.size(), 12U);
    EXPECT_EQ(bodies[0].name, "row.0");
    EXPECT_EQ(bodies[11].name, "row.11");  // after row.2, not before it
    const dvec3 shift = bodies[11].model.positions[0] - bodies[0].model.positions[0];
    EXPECT_EQ(shift, dvec3(4.0, 1.5, -3.0));
}

TEST(Bodies, AreSortedByKindAndName) {
    SceneSpec scene;
    scene.bodies.add(support::rope("a", {0, 0, 0}, {1, 0, 0}));
    scene.bodies.add(support::cloth("b"), support::cloth("c"));
    const std::vector<Body> bodies = buildBodies(scene);
    EXPECT_EQ(bodies[0].fullName(), "cloth.b");
    EXPECT_EQ(bodies[1].fullName(), "cloth.c");
    EXPECT_EQ(bodies[2].fullName(), "rope.a");
}

TEST(Bodies, AddedMassIsSharedAmongTheTargets) {
    SceneSpec scene;
    scene.bodies.add(support::rope("a", {0, 0, 0}, {1, 0, 0}));
    scene.masses = {{"rope.a@ends", 3.0, {}}};
    const std::vector<Body> bodies = buildBodies(scene);
    EXPECT_NEAR(massOf(bodies[0]), 4.0, 1e-14);
    EXPECT_NEAR(bodies[0].model.masses[0], 0.05 + 1.5, 1e-14);  // half a segment's share of 1 kg, and half of 3 kg
}

TEST(Bodies, AHoldThatNamesNothingIsAnError) {
    SceneSpec scene;
    ClothSpec spec = support::cloth("a");
    spec.hold = {"middle"};
    spec.source = {"x.toml", 3, 4};
    scene.bodies.add(spec);
    try {
        buildBodies(scene);
        FAIL();
    } catch (const core::Error& error) {
        EXPECT_STREQ(error.what(), "x.toml:3:4: error: hold = \"middle\" names no point of cloth.a");
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
    }
}

TEST(Bodies, SpinTurnsAboutTheCentreOfMass) {
    SceneSpec scene;
    BlockSpec spec;
    spec.name = "b";
    spec.velocity = {1.0, 0.0, 0.0};
    spec.spin = {0.0, 3.0, 0.0};
    scene.bodies.add(spec);
    const std::vector<Body> bodies = buildBodies(scene);
    dvec3 momentum(0.0), angular(0.0);
    for (std::size_t i = 0; i < bodies[0].model.positions.size(); ++i) {
        momentum += bodies[0].model.masses[i] * bodies[0].model.velocities[i];
        angular += bodies[0].model.masses[i] * glm::cross(bodies[0].model.positions[i], bodies[0].model.velocities[i]);
    }
    EXPECT_NEAR(momentum.x, massOf(bodies[0]), 1e-12);
    EXPECT_NEAR(momentum.y, 0.0, 1e-12);
    EXPECT_GT(angular.y, 0.0);
    EXPECT_NEAR(angular.x, 0.0, 1e-12);
}

TEST(Bodies, JitterIsSmallSeededAndSparesHeldPoints) {
    SceneSpec scene;
    ClothSpec spec = support::cloth("a");
    spec.hold = {"top"};
    spec.jitter = 1e-3;
    scene.bodies.add(spec);
    const Body one = buildBodies(scene)[0], again = buildBodies(scene)[0];
    scene.bodies.of<ClothSpec>()[0].seed = 2;
    const Body other = buildBodies(scene)[0];
    scene.bodies.of<ClothSpec>()[0].jitter = 0.0;
    const Body still = buildBodies(scene)[0];
    EXPECT_EQ(one.model.positions, again.model.positions);
    double largest = 0.0;
    for (std::size_t i = 0; i < one.model.positions.size(); ++i) {
        const dvec3 d = one.model.positions[i] - still.model.positions[i];
        largest = std::max({largest, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        if (one.model.held[i])
            EXPECT_EQ(d, dvec3(0.0));
        else
            EXPECT_NE(one.model.positions[i], other.model.positions[i]);
    }
    EXPECT_LE(largest, 1e-3);
    EXPECT_GT(largest, 0.9e-3);  // of over two hundred even numbers one comes near the bound
}

}  // namespace
}  // namespace taut::world
