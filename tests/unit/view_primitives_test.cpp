#include "taut/view/primitives.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "view_mesh_facts.h"

namespace taut::view::test {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Rounding of a normalised float vector is a few units in the last place, 1e-7 each.
constexpr float unitTolerance = 1e-6F;

void expectSolid(const Mesh& mesh, float expectedVolume, float relativeTolerance) {
    ASSERT_EQ(mesh.geometry->positions.size(), mesh.geometry->normals.size());
    ASSERT_EQ(mesh.geometry->positions.size(), mesh.topology->uv.size());
    EXPECT_EQ(openEdges(*mesh.topology, *mesh.geometry), 0);
    EXPECT_LT(normalLengthError(*mesh.geometry), unitTolerance);
    // A facet leans from the surface by at most half a step: 20 to 64 steps a turn, 16 a turn on a box's
    // edges (its corners' facets lean a little more); 0.9 is the cosine of 26 degrees.
    EXPECT_GT(leastAgreement(*mesh.topology, *mesh.geometry), 0.9F);
    EXPECT_NEAR(volume(*mesh.topology, *mesh.geometry), expectedVolume, relativeTolerance * expectedVolume);
}

void expectExtent(const Mesh& mesh, glm::vec3 halfSize) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(-std::numeric_limits<float>::max());
    for (const glm::vec3& p : mesh.geometry->positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    for (int axis = 0; axis < 3; ++axis) {
        // Positions of the order of 1 m, a few roundings.
        EXPECT_NEAR(low[axis], -halfSize[axis], 1e-6F);
        EXPECT_NEAR(high[axis], halfSize[axis], 1e-6F);
    }
}

// A 64-cornered circle has 0.16 % less area than the round one, a 32-step meridian as much less again.
TEST(ViewPrimitives, SphereIsClosedAndFacesOutwards) {
    const Mesh mesh = sphereMesh(0.5F);
    expectSolid(mesh, 4.0F / 3.0F * pi * 0.125F, 0.005F);
    expectExtent(mesh, glm::vec3(0.5F));
    for (std::size_t i = 0; i < mesh.geometry->positions.size(); ++i)
        EXPECT_NEAR(glm::dot(mesh.geometry->positions[i], mesh.geometry->normals[i]), 0.5F, 1e-6F);
}

TEST(ViewPrimitives, SmallSpheresHaveFewerTriangles) {
    const Mesh large = sphereMesh(0.5F);
    const Mesh small = sphereMesh(0.05F);
    EXPECT_LT(small.topology->triangles.size(), large.topology->triangles.size() / 5);
    // Twenty corners a turn: 1.6 % less area than the circle, the meridian as much less again.
    expectSolid(small, 4.0F / 3.0F * pi * 0.000125F, 0.04F);
    expectExtent(small, glm::vec3(0.05F));
}

TEST(ViewPrimitives, CylinderIsClosedAndFacesOutwards) {
    const Mesh mesh = cylinderMesh(0.6F, 1.0F);
    // The rounded rim takes away less than 0.1 %.
    expectSolid(mesh, pi * 0.36F, 0.004F);
    expectExtent(mesh, {0.6F, 0.5F, 0.6F});
}

TEST(ViewPrimitives, ConeStandsOnItsBaseWithTheTipUp) {
    const Mesh mesh = coneMesh(0.6F, 0.8F);
    // The rounded rim takes away under 1 % of the volume.
    expectSolid(mesh, pi * 0.36F * 0.8F / 3.0F, 0.015F);
    EXPECT_EQ(mesh.geometry->positions.back(), glm::vec3(0.0F, 0.4F, 0.0F));
    EXPECT_EQ(mesh.geometry->positions.front(), glm::vec3(0.0F, -0.4F, 0.0F));
}

TEST(ViewPrimitives, CapsuleIsTwoHalfSpheresAndACylinder) {
    const Mesh mesh = capsuleMesh(0.5F, 0.6F);
    expectSolid(mesh, pi * 0.25F * 0.6F + 4.0F / 3.0F * pi * 0.125F, 0.005F);
    expectExtent(mesh, {0.5F, 0.8F, 0.5F});
}

TEST(ViewPrimitives, CapsuleWithoutHeightIsASphere) {
    const Mesh mesh = capsuleMesh(0.5F, 0.0F);
    expectSolid(mesh, 4.0F / 3.0F * pi * 0.125F, 0.005F);
    expectExtent(mesh, glm::vec3(0.5F));
}

TEST(ViewPrimitives, BoxWithSharpEdgesHasTwelveTriangles) {
    const Mesh mesh = boxMesh({1.0F, 0.5F, 0.25F}, 0.0F);
    EXPECT_EQ(mesh.topology->triangles.size(), 36U);
    expectSolid(mesh, 1.0F, 1e-6F);
    expectExtent(mesh, {1.0F, 0.5F, 0.25F});
}

TEST(ViewPrimitives, BoxWithRoundEdgesIsClosedAndKeepsItsSize) {
    const float r = 0.05F;
    const glm::vec3 inner = glm::vec3(1.0F, 0.5F, 0.25F) - glm::vec3(r);
    // Steiner's formula for a box grown by a ball.
    const float exact = 8.0F * inner.x * inner.y * inner.z +
                        8.0F * r * (inner.x * inner.y + inner.y * inner.z + inner.z * inner.x) +
                        2.0F * pi * r * r * (inner.x + inner.y + inner.z) + 4.0F / 3.0F * pi * r * r * r;
    const Mesh mesh = boxMesh({1.0F, 0.5F, 0.25F}, r);
    // Four steps a quarter turn miss 2.5 % of the edges' volume, which is 2 % of the whole.
    expectSolid(mesh, exact, 1e-3F);
    expectExtent(mesh, {1.0F, 0.5F, 0.25F});
}

// Above the middle as the one before; below a prism over a rectangle grown by a disc.
TEST(ViewPrimitives, BoxThatStandsIsRoundButForItsFoot) {
    const float r = 0.05F;
    const glm::vec3 half(1.0F, 0.5F, 0.25F), inner = half - glm::vec3(r);
    const float round = 8.0F * inner.x * inner.y * inner.z +
                        8.0F * r * (inner.x * inner.y + inner.y * inner.z + inner.z * inner.x) +
                        2.0F * pi * r * r * (inner.x + inner.y + inner.z) + 4.0F / 3.0F * pi * r * r * r;
    const float prism = half.y * (4.0F * inner.x * inner.z + 4.0F * r * (inner.x + inner.z) + pi * r * r);
    const Mesh mesh = boxMesh(half, r, true);
    expectSolid(mesh, 0.5F * round + prism, 1e-3F);
    expectExtent(mesh, half);
    for (std::size_t i = 0; i < mesh.geometry->positions.size(); ++i)
        EXPECT_TRUE(mesh.geometry->normals[i].y > -1e-6F || mesh.geometry->normals[i].y == -1.0F);
}

TEST(ViewPrimitives, BoxRoundedAsFarAsItGoesIsASphere) {
    const Mesh mesh = boxMesh(glm::vec3(0.5F), 9.0F);
    EXPECT_EQ(openEdges(*mesh.topology, *mesh.geometry), 0);
    for (const glm::vec3& p : mesh.geometry->positions) EXPECT_NEAR(glm::length(p), 0.5F, 1e-6F);
}

TEST(ViewPrimitives, QuadFacesItsNormal) {
    const glm::vec3 normal = glm::normalize(glm::vec3(0.2F, 1.0F, -0.3F));
    const Mesh mesh = quadMesh(3.0F * normal, 2.0F);
    EXPECT_GT(leastAgreement(*mesh.topology, *mesh.geometry), 1.0F - unitTolerance);
    for (const glm::vec3& p : mesh.geometry->positions) {
        EXPECT_NEAR(glm::dot(p, normal), 0.0F, 1e-6F);
        EXPECT_NEAR(glm::length(p), 2.0F * std::numbers::sqrt2_v<float>, 1e-6F);
    }
}

const std::vector<glm::vec3> roof{{0.0F, 1.0F, 0.0F}, {0.0F, 1.0F, 1.0F}, {1.0F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F}};
const std::vector<std::uint32_t> roofTriangles{0, 1, 2, 1, 0, 3};  // two slopes that meet at a right angle

TEST(ViewNormals, CreaseSharperThanTheAngleSplitsVertices) {
    const Mesh mesh = creasedMesh(roof, roofTriangles, 1.0F);
    EXPECT_EQ(mesh.geometry->positions.size(), 6U);
    EXPECT_GT(leastAgreement(*mesh.topology, *mesh.geometry), 1.0F - unitTolerance);
}

TEST(ViewNormals, CreaseBelowTheAngleIsSmooth) {
    const Mesh mesh = creasedMesh(roof, roofTriangles, 2.0F);
    EXPECT_EQ(mesh.geometry->positions.size(), 4U);
    EXPECT_NEAR(mesh.geometry->normals[0].y, 1.0F, unitTolerance);
}

TEST(ViewNormals, SmoothNormalsWeighByArea) {
    // A triangle of area 1/2 in the floor and one of area 3/2 in a wall share an edge.
    const std::vector<glm::vec3> positions{
        {0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, -3.0F, 0.0F}};
    const std::vector<std::uint32_t> triangles{0, 1, 2, 0, 3, 1};
    std::vector<glm::vec3> normals(4);
    smoothNormals(positions, triangles, normals);
    const glm::vec3 expected = glm::normalize(glm::vec3(3.0F, 1.0F, 0.0F));
    EXPECT_NEAR(glm::distance(glm::abs(normals[0]), expected), 0.0F, unitTolerance);
    EXPECT_NEAR(normals[2].y, 1.0F, unitTolerance);
}

TEST(ViewNormals, VertexWithoutAreaPointsUp) {
    const std::vector<glm::vec3> positions{
        {0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F}, {9.0F, 9.0F, 9.0F}};
    const std::vector<std::uint32_t> flat{0, 1, 2};
    std::vector<glm::vec3> normals(4, glm::vec3(5.0F));
    smoothNormals(positions, flat, normals);
    for (const glm::vec3& n : normals) EXPECT_EQ(n, glm::vec3(0.0F, 1.0F, 0.0F));
}

TEST(ViewNormals, TinyTrianglesKeepTheirDirection) {
    // An area of 1e-38 m² is close to the smallest float; its square is zero.
    const std::vector<glm::vec3> positions{{0.0F, 0.0F, 0.0F}, {1e-19F, 0.0F, 0.0F}, {0.0F, 1e-19F, 0.0F}};
    const std::vector<std::uint32_t> triangle{0, 1, 2};
    std::vector<glm::vec3> normals(3);
    smoothNormals(positions, triangle, normals);
    for (const glm::vec3& n : normals) EXPECT_NEAR(n.z, 1.0F, unitTolerance);
}

}  // namespace
}  // namespace taut::view::test
