// Distances to every shape, against formulas written differently and against Bullet's own shapes.
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <gtest/gtest.h>

#include "collision_support.h"

namespace taut::collision {
namespace {

double distanceTo(const SizedShape& shape, const glm::dvec3& p, const Pose& pose = {}) {
    Colliders colliders;
    colliders.add(shape, {}, pose);
    return colliders.distance(p);
}

// Bullet's distance to a convex shape whose margin is not part of it: GJK outside, EPA inside.
double bulletDistance(const btConvexShape& shape, const glm::dvec3& p, double margin) {
    btGjkEpaSolver2::sResults found;
    btSphereShape point(0.0);
    btTransform here = btTransform::getIdentity();
    btTransform there = btTransform::getIdentity();
    there.setOrigin(btVector3(p.x, p.y, p.z));
    if (btGjkEpaSolver2::Distance(&shape, here, &point, there, btVector3(1, 1, 1), found))
        return (found.witnesses[0] - found.witnesses[1]).length() - margin;
    btGjkEpaSolver2::Penetration(&shape, here, &point, there, btVector3(1, 1, 1), found, true);
    return -(found.witnesses[0] - found.witnesses[1]).length();
}

// GJK and EPA stop at a relative 1e-12 where they converge; round shapes are met by EPA's polytope only to about
// 1e-3 of their size, so inside only the sign is compared.
void expectAgreement(const SizedShape& shape, const btConvexShape& bullet, double margin, double tolerance) {
    Colliders colliders;
    colliders.add(shape, {}, {});
    Numbers numbers;
    int outside = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p = numbers.point(1.5);
        const double ours = colliders.distance(p);
        if (ours < 0.02) continue;
        ++outside;
        ASSERT_NEAR(ours, bulletDistance(bullet, p, margin), tolerance) << p.x << " " << p.y << " " << p.z;
    }
    EXPECT_GT(outside, 500);
}

TEST(CollisionDistance, PlaneIsTheHeightAlongItsNormal) {
    // Normal (0.6, 0.8, 0) scaled by 5: at (1, 2, 3) the height is 0.6 + 1.6; rounding of three products.
    EXPECT_NEAR(distanceTo(planeShape({3.0, 4.0, 0.0}), {1.0, 2.0, 3.0}), 2.2, 1e-15);
    Pose pose;
    pose.position = {0.0, 1.0, 0.0};
    EXPECT_EQ(distanceTo(planeShape(), {5.0, 0.25, 5.0}, pose), -0.75);
}

TEST(CollisionDistance, SphereIsTheRadiusAway) {
    EXPECT_EQ(distanceTo(roundShape("sphere", 0.5), {3.0, 4.0, 0.0}), 4.5);
    EXPECT_EQ(distanceTo(roundShape("sphere", 0.5), {0.0, 0.0, 0.0}), -0.5);
}

TEST(CollisionDistance, BoxAgreesWithBullet) {
    // Bullet keeps a box as a smaller one with a margin of 4 cm round it and rounds its corners by that in GJK's
    // distance, therefore the margin is set to zero here. 1e-9: ten thousand times GJK's tolerance times the size.
    btBoxShape box(btVector3(0.3, 0.5, 0.7));
    box.setMargin(0.0);
    expectAgreement(boxShape({0.3, 0.5, 0.7}), box, 0.0, 1e-9);
}

TEST(CollisionDistance, CapsuleAgreesWithBullet) {
    btCapsuleShape capsule(0.3, 0.8);
    // GJK sees the segment; the radius is the margin.
    expectAgreement(roundShape("capsule", 0.3, 0.8), capsule, 0.3, 1e-9);
}

TEST(CollisionDistance, CylinderAgreesWithBullet) {
    // 1e-5: on a curved rim GJK converges linearly and Bullet stops it after 128 rounds.
    btCylinderShape cylinder(btVector3(0.4, 0.6, 0.4));
    cylinder.setMargin(0.0);
    expectAgreement(roundShape("cylinder", 0.4, 1.2), cylinder, 0.0, 1e-5);
}

TEST(CollisionDistance, ConeAgreesWithBullet) {
    btConeShape cone(0.5, 1.2);
    cone.setMargin(0.0);
    expectAgreement(roundShape("cone", 0.5, 1.2), cone, 0.0, 1e-5);
}

TEST(CollisionDistance, HullAndMeshOfABoxAreTheBox) {
    const glm::dvec3 half(0.3, 0.5, 0.7);
    Colliders box;
    Colliders hull;
    Colliders mesh;
    Colliders compound;
    box.add(boxShape(half), {}, {});
    hull.add(boxHull(half), {}, {});
    mesh.add(boxMesh(half), {}, {});
    compound.add(compoundOf(boxShape(half)), {}, {});
    Numbers numbers;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 p = numbers.point(1.5);
        const double expected = box.distance(p);
        ASSERT_NEAR(hull.distance(p), expected, 1e-10) << i;  // GJK's 1e-12 near edges, with room
        ASSERT_NEAR(mesh.distance(p), expected, 1e-13) << i;  // rounding
        ASSERT_EQ(compound.distance(p), expected) << i;
    }
}

TEST(CollisionDistance, FollowsThePose) {
    const glm::dvec3 half(0.3, 0.5, 0.7);
    Pose pose;
    pose.position = {1.0, 2.0, 3.0};
    pose.rotation = turned({1.0, 2.0, -1.0}, 0.8);
    Pose part;
    part.position = {0.1, 0.0, -0.2};
    part.rotation = turned({0.0, 1.0, 1.0}, 2.0);
    Numbers numbers;
    Colliders moved;
    moved.add(compoundOf(boxShape(half), part), {}, pose);
    Colliders still;
    still.add(boxShape(half), {}, {});
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 p = numbers.point(1.0);
        const glm::dvec3 inWorld = pose.position + pose.rotation * (part.position + part.rotation * p);
        ASSERT_NEAR(moved.distance(inWorld), still.distance(p), 1e-14);  // rounding of two rotations
    }
}

TEST(CollisionDistance, InsideIsTheDepthUnderTheNearestFace) {
    // Centre and places near each face of a cone: depth = height over the side, R cos or the base, by hand.
    const SizedShape cone = roundShape("cone", 0.3, 0.4);  // slant 0.5
    EXPECT_NEAR(distanceTo(cone, {0.0, -0.19, 0.0}), -0.01, 1e-15);
    // On the axis, 0.1 under the apex: 0.1 · 0.3 / 0.5 from the side.
    EXPECT_NEAR(distanceTo(cone, {0.0, 0.1, 0.0}), -0.06, 1e-15);
    const SizedShape cylinder = roundShape("cylinder", 0.3, 2.0);
    EXPECT_NEAR(distanceTo(cylinder, {0.0, 0.2, 0.25}), -0.05, 1e-15);
    EXPECT_NEAR(distanceTo(cylinder, {0.0, 0.95, 0.1}), -0.05, 1e-15);
    EXPECT_NEAR(distanceTo(roundShape("capsule", 0.3, 2.0), {0.1, -0.4, 0.0}), -0.2, 1e-15);
    EXPECT_NEAR(distanceTo(boxShape({1.0, 2.0, 3.0}), {0.9, 0.0, 0.0}), -0.1, 1e-15);
}

TEST(CollisionDistance, OpenMeshHasTwoSidesAndNoInside) {
    Colliders sheet;
    sheet.add(sheetMesh(1.0, 7), {}, {});
    EXPECT_NEAR(sheet.distance({0.3, 0.2, -0.4}), 0.2, 1e-15);
    EXPECT_NEAR(sheet.distance({0.3, -0.2, -0.4}), 0.2, 1e-15);
    EXPECT_NEAR(sheet.distance({1.3, 0.4, 0.0}), 0.5, 1e-15);  // 3-4-5 from the edge
}

TEST(CollisionDistance, SphereOfTrianglesHasItsInsideInside) {
    // A closed mesh with many edges and corners: the sign has to be right everywhere. An octahedron, divided.
    SizedShape mesh;
    mesh.kind = "mesh";
    constexpr std::uint32_t rings = 16;
    constexpr std::uint32_t around = 32;
    mesh.vertices.emplace_back(0.0, 1.0, 0.0);
    for (std::uint32_t r = 1; r < rings; ++r)
        for (std::uint32_t a = 0; a < around; ++a) {
            const double polar = core::pi * r / rings;
            const double turn = 2.0 * core::pi * a / around;
            mesh.vertices.emplace_back(core::sine(polar) * core::cosine(turn), core::cosine(polar),
                                       core::sine(polar) * core::sine(turn));
        }
    mesh.vertices.emplace_back(0.0, -1.0, 0.0);
    const auto at = [](std::uint32_t r, std::uint32_t a) { return 1 + (r - 1) * around + a % around; };
    const std::uint32_t bottom = 1 + (rings - 1) * around;
    for (std::uint32_t a = 0; a < around; ++a) {
        mesh.triangles.insert(mesh.triangles.end(), {0, at(1, a + 1), at(1, a)});
        for (std::uint32_t r = 1; r + 1 < rings; ++r) {
            mesh.triangles.insert(mesh.triangles.end(), {at(r, a), at(r, a + 1), at(r + 1, a)});
            mesh.triangles.insert(mesh.triangles.end(), {at(r, a + 1), at(r + 1, a + 1), at(r + 1, a)});
        }
        mesh.triangles.insert(mesh.triangles.end(), {bottom, at(rings - 1, a), at(rings - 1, a + 1)});
    }
    SizedShape insideOut = mesh;
    for (std::size_t i = 0; i < insideOut.triangles.size(); i += 3)
        std::swap(insideOut.triangles[i], insideOut.triangles[i + 1]);
    Colliders colliders;
    colliders.add(mesh, {}, {});
    Colliders turnedRound;
    turnedRound.add(insideOut, {}, {});
    Numbers numbers;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 p = numbers.point(1.3);
        // The mesh lies between the sphere and the one that its flat faces reach down to: a sagitta of
        // 1 - cos(pi / 32) along a meridian and another round it, together under 0.0097.
        const double toSphere = glm::length(p) - 1.0;
        ASSERT_GE(colliders.distance(p), toSphere - 1e-14);
        ASSERT_LE(colliders.distance(p), toSphere + 0.0097);
        ASSERT_NEAR(turnedRound.distance(p), colliders.distance(p), 1e-14);
    }
}

TEST(CollisionDistance, HullOfARealModelAgreesWithBullet) {
    const SizedShape shape = readObj("/usr/share/assimp/models/OBJ/spider.obj", "hull");
    if (shape.vertices.empty()) FAIL() << "install the package assimp-testmodels; game/packages.txt lists it";
    Colliders colliders;
    colliders.add(shape, {}, {});
    btConvexHullShape bullet;
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const glm::dvec3& v : shape.vertices) {
        bullet.addPoint(btVector3(v.x, v.y, v.z), false);
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    bullet.setMargin(0.0);
    const double size = glm::length(high - low);
    const auto form = builtInShapes().find("hull")->shape(shape).form;
    Numbers numbers;
    double worst = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p = 0.5 * (low + high) + numbers.point(0.7 * size);
        const double ours = colliders.distance(p);
        const double theirs = bulletDistance(bullet, p, 0.0);
        worst = std::max(worst, std::abs(ours - theirs));
        // No plane with the vertices behind it is higher under the point than the one at its nearest place: duality.
        // 1e-11: the vertices are rounded to 1e-12 of the size when the corners are found.
        const Nearest near = form->nearest(p);
        double support = -1e300;
        for (const glm::dvec3& v : shape.vertices) support = std::max(support, glm::dot(near.normal, v));
        ASSERT_NEAR(near.distance, glm::dot(near.normal, p) - support, 1e-11 * size) << i;
    }
    EXPECT_LT(worst, 1e-6 * size);  // the error of Bullet's GJK and EPA
    // Every vertex lies inside or on the surface.
    for (const glm::dvec3& v : shape.vertices) ASSERT_LT(colliders.distance(v), 1e-9 * size);
}

}  // namespace
}  // namespace taut::collision
