// Invalid shapes, materials and poses: each is an error that names the fault.
#include <gtest/gtest.h>

#include "collision_support.h"
#include "taut/core/error.h"

namespace taut::collision {
namespace {

void expectRefused(const SizedShape& shape, const std::string& message, const Material& material = {},
                   const Pose& pose = {}) {
    Colliders colliders;
    try {
        colliders.add(shape, material, pose);
        FAIL() << "accepted, expected: " << message;
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        EXPECT_EQ(std::string(error.what()), message);
        EXPECT_EQ(colliders.size(), 0);
    }
}

SizedShape hullOf(std::vector<glm::dvec3> vertices) {
    SizedShape shape;
    shape.kind = "hull";
    shape.vertices = std::move(vertices);
    return shape;
}

TEST(CollisionShape, SizesNotAboveZeroAreRefused) {
    expectRefused(roundShape("sphere", 0.0), "sphere: the radius has to be above zero, is 0.000000");
    expectRefused(roundShape("capsule", -1.0), "capsule: the radius has to be above zero, is -1.000000");
    expectRefused(roundShape("cylinder", 1.0, 0.0), "cylinder: the height has to be above zero, is 0.000000");
    expectRefused(roundShape("cone", 1.0, std::numeric_limits<double>::quiet_NaN()),
                  "cone: the height has to be above zero, is nan");
    expectRefused(boxShape({1.0, 0.0, 1.0}), "box: a half size has to be above zero, is 0.000000");
    expectRefused(boxShape({1.0, 1.0, std::numeric_limits<double>::infinity()}),
                  "box: a half size has to be above zero, is inf");
    expectRefused(planeShape({0.0, 0.0, 0.0}), "plane: its normal has no direction");
}

TEST(CollisionShape, HullWithoutVolumeIsRefused) {
    expectRefused(hullOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "hull: needs at least four vertices, has 3");
    const std::string flat = "hull: its vertices lie in one plane, so it has no volume";
    expectRefused(hullOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), flat);
    expectRefused(hullOf({{0, 1, 0}, {0.3, 1, 0.2}, {0.7, 1, 0.1}, {0.4, 1, 0.9}, {0.1, 1, 0.5}}), flat);
    expectRefused(hullOf({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), flat);
    expectRefused(hullOf({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), flat);
    expectRefused(hullOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::numeric_limits<double>::infinity()}}),
                  "hull: a vertex is not finite");
}

TEST(CollisionShape, FlatTurnedHullIsRefused) {
    // In one plane but for rounding.
    SizedShape shape = hullOf({});
    const glm::dquat turn = turned({1.0, 2.0, 3.0}, 0.7);
    for (int i = 0; i < 12; ++i)
        shape.vertices.push_back(turn * glm::dvec3(core::cosine(0.5 * i), 0.0, core::sine(0.5 * i)));
    expectRefused(shape, "hull: its vertices lie in one plane, so it has no volume");
}

TEST(CollisionShape, MeshWithoutTrianglesIsRefused) {
    SizedShape mesh = boxMesh({1.0, 1.0, 1.0});
    mesh.triangles.clear();
    expectRefused(mesh, "collider mesh: has no triangles");
    mesh.triangles = {0, 1};
    expectRefused(mesh, "collider mesh: the number of its corners is not a multiple of three");
    mesh.triangles = {0, 1, 8};
    expectRefused(mesh, "collider mesh: a triangle names vertex 8, there are 8");
    mesh.triangles = {0, 1, 1, 2, 2, 2};
    expectRefused(mesh, "collider mesh: all its triangles have no area");
    mesh.triangles = {0, 1, 2};
    mesh.vertices[7].x = std::numeric_limits<double>::quiet_NaN();
    expectRefused(mesh, "collider mesh: a vertex is not finite");
}

TEST(CollisionShape, BadPartsMaterialsAndPosesAreRefused) {
    SizedShape compound;
    compound.kind = "compound";
    expectRefused(compound, "collider compound: has no parts");
    expectRefused(compoundOf(roundShape("sphere", -2.0)), "sphere: the radius has to be above zero, is -2.000000");
    const SizedShape ball = roundShape("sphere", 1.0);
    expectRefused(ball, "collider material: the friction has to be zero or more", {-0.1, 0.0});
    expectRefused(ball, "collider material: the restitution has to be from 0 to 1", {0.3, 1.1});
    expectRefused(ball, "collider pose: the position is not finite", {},
                  {.position = {0.0, std::numeric_limits<double>::infinity(), 0.0}});
    expectRefused(ball, "collider pose: the rotation is not a quaternion of length above zero", {},
                  {.rotation = {0.0, 0.0, 0.0, 0.0}});
}

TEST(CollisionShape, RotationNeedNotBeOfUnitLength) {
    Colliders colliders;
    colliders.add(boxShape({1.0, 2.0, 3.0}), {}, {.rotation = 5.0 * turned({0.0, 0.0, 1.0}, 0.5 * core::pi)});
    EXPECT_NEAR(colliders.distance({4.0, 0.0, 0.0}), 2.0, 1e-14);
}

TEST(CollisionShape, MeshWithASliverAndRepeatedVerticesIsClosed) {
    // As in files where every face has its own corners; a sliver of no area between two of them does not matter.
    const SizedShape box = boxMesh({0.5, 0.5, 0.5});
    SizedShape soup;
    soup.kind = "mesh";
    for (const std::uint32_t corner : box.triangles) {
        soup.triangles.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
        soup.vertices.push_back(box.vertices[corner]);
    }
    soup.triangles.insert(soup.triangles.end(), {0, 1, 0});
    Colliders colliders;
    EXPECT_EQ(colliders.add(soup, {}, {}), 0);
    EXPECT_EQ(colliders.size(), 1);
    EXPECT_NEAR(colliders.distance({0.1, 0.3, 0.0}), -0.2, 1e-15);
}

TEST(CollisionShape, CloneMovesOnItsOwn) {
    Colliders first;
    first.add(boxHull({0.5, 0.5, 0.5}), {}, {});
    first.add(boxMesh({0.5, 0.5, 0.5}), {}, {{5.0, 0.0, 0.0}});
    Colliders second = first.clone();
    second.move(0, {}, {.position = {0.0, 1.0, 0.0}});
    EXPECT_EQ(second.size(), 2);
    EXPECT_EQ(first.distance({0.0, 2.0, 0.0}), 1.5);
    EXPECT_EQ(second.distance({0.0, 2.0, 0.0}), 0.5);
    EXPECT_EQ(second.distance({5.0, 1.0, 0.0}), first.distance({5.0, 1.0, 0.0}));
}

TEST(CollisionShape, RealModelsHoldAPoint) {
    // A point that falls on the hull or on the mesh of a model comes to rest on it, at its thickness.
    for (const char* name : {"box.obj", "spider.obj", "WusonOBJ.obj", "regr01.obj"}) {
        for (const std::string kind : {"hull", "mesh"}) {
            const SizedShape shape = readObj(std::string("/usr/share/assimp/models/OBJ/") + name, kind);
            if (shape.vertices.empty()) FAIL() << "install the package assimp-testmodels; game/packages.txt lists it";
            Colliders colliders;
            colliders.add(shape, {5.0, 0.0}, {});
            glm::dvec3 low = shape.vertices[0];
            glm::dvec3 high = low;
            for (const glm::dvec3& v : shape.vertices) {
                low = glm::min(low, v);
                high = glm::max(high, v);
            }
            const double size = glm::length(high - low);
            for (int i = 0; i < 40; ++i) {
                const double a = (i % 8 + 0.5) / 8.0;
                const double b = (i / 8 + 0.5) / 5.0;
                Flyer<double> point({low.x + a * (high.x - low.x), high.y + 0.1 * size, low.z + b * (high.z - low.z)});
                point.thickness = 1e-3 * size;
                double least = 1e300;
                for (int s = 0; s < 600; ++s) {
                    point.step(colliders, 1e-2, {0.0, -0.1 * size, 0.0});
                    least = std::min(least, colliders.distance(point.position()));
                }
                // 1e-9: GJK's 1e-12 and rounding, times the size. In a narrow fold of a mesh, where two sides press,
                // a point may come nearer than its thickness, but not through.
                if (kind == "hull")
                    EXPECT_GT(least, (1e-3 - 1e-9) * size) << name << i;
                else
                    EXPECT_GT(least, 0.0) << name << i;
            }
        }
    }
}

}  // namespace
}  // namespace taut::collision
