// The parts of a shape that reach between points: counts and places by geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "collision_support.h"
#include "taut/collision/outline.h"

namespace taut::collision {
namespace {

using Ends = std::pair<std::array<double, 3>, std::array<double, 3>>;

Ends endsOf(const Outline& outline, const Outline::Edge& edge) {
    const auto at = [&](int i) {
        const dvec3& p = outline.vertices[i];
        return std::array<double, 3>{p.x, p.y, p.z};
    };
    return std::minmax(at(edge.a), at(edge.b));
}

std::set<Ends> edgesOf(const Outline& outline) {
    std::set<Ends> edges;
    for (const Outline::Edge& edge : outline.edges) edges.insert(endsOf(outline, edge));
    return edges;
}

Outline outlineOfOnly(const Shape& shape) {
    const std::vector<Outline> all = outlinesOf(shape);
    EXPECT_EQ(all.size(), 1u);
    return all.front();
}

// A polygon in the plane z = 0 given as triangles, and the same at z = 1; walls between.
SizedShape prism(const std::vector<glm::dvec2>& polygon, const std::vector<std::array<std::uint32_t, 3>>& caps) {
    SizedShape shape;
    shape.kind = "mesh";
    const auto n = static_cast<std::uint32_t>(polygon.size());
    for (const double z : {0.0, 1.0})
        for (const glm::dvec2& p : polygon) shape.vertices.emplace_back(p.x, p.y, z);
    for (const auto& [a, b, c] : caps) {
        shape.triangles.insert(shape.triangles.end(), {c, b, a});
        shape.triangles.insert(shape.triangles.end(), {n + a, n + b, n + c});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        shape.triangles.insert(shape.triangles.end(), {i, j, n + j, i, n + j, n + i});
    }
    return shape;
}

// Its diagonals and the middle of its faces are inner edges; files may turn it inside out.
TEST(CollisionOutline, ABoxIsTheSameAsAHullAndAMesh) {
    const Outline box = outlineOfOnly(boxHull({0.5, 0.5, 0.5}));
    EXPECT_EQ(box.corners.size(), 8u);
    EXPECT_EQ(box.edges.size(), 12u);
    SizedShape mesh = prism({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, {{0, 1, 2}, {0, 2, 3}});
    for (glm::dvec3& v : mesh.vertices) v.z -= 0.5;
    const auto expectSame = [&](const SizedShape& shape) {
        const Outline other = outlineOfOnly(shape);
        EXPECT_EQ(other.corners.size(), 8u);
        EXPECT_EQ(edgesOf(other), edgesOf(box));
    };
    expectSame(mesh);
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    expectSame(mesh);
}

TEST(CollisionOutline, WingsLieOnTheTwoFacesBesideAnEdge) {
    for (const Outline& outline :
         {outlineOfOnly(boxHull({0.5, 1.0, 1.5})), outlineOfOnly(prism({{0, 0}, {1, 0}, {0.3, 0.8}}, {{0, 1, 2}}))})
        for (const Outline::Edge& edge : outline.edges) {
            ASSERT_TRUE(edge.wingA >= 0 && edge.wingB >= 0);
            const auto at = [&](int i) { return outline.vertices[i]; };
            const glm::dvec3 along = at(edge.b) - at(edge.a);
            const glm::dvec3 one = glm::cross(along, at(edge.wingA) - at(edge.a));
            const glm::dvec3 other = glm::cross(at(edge.wingB) - at(edge.a), along);
            // All of a convex solid lies behind both faces.
            for (const glm::dvec3& normal : {one, other}) {
                double low = 0, high = 0;
                for (const glm::dvec3& v : outline.vertices) {
                    low = std::min(low, glm::dot(normal, v - at(edge.a)));
                    high = std::max(high, glm::dot(normal, v - at(edge.a)));
                }
                EXPECT_LT(std::min(-low, high), 1e-15);
            }
            EXPECT_GT(glm::length(glm::cross(one, other)), 0.1);
        }
}

// Of the 18 edges of an L one lies in a valley.
TEST(CollisionOutline, EdgesInValleysAreLeftOut) {
    const std::vector<glm::dvec2> polygon{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    const Outline outline = outlineOfOnly(prism(polygon, {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}));
    EXPECT_EQ(outline.edges.size(), 17u);
    EXPECT_EQ(edgesOf(outline).count({{1, 1, 0}, {1, 1, 1}}), 0u);
    EXPECT_EQ(outline.corners.size(), 12u);
}

TEST(CollisionOutline, AnOpenSheetHasItsBorder) {
    SizedShape shape;
    shape.kind = "mesh";
    shape.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
    shape.triangles = {0, 1, 2, 0, 2, 3};
    const Outline outline = outlineOfOnly(shape);
    EXPECT_EQ(outline.edges.size(), 4u);
    for (const Outline::Edge& edge : outline.edges) EXPECT_TRUE(edge.wingA >= 0 && edge.wingB < 0);
}

// Shapes with a distance formula need no outline: edges and faces use that formula.
TEST(CollisionOutline, OfFormulasIsNothing) {
    EXPECT_TRUE(outlinesOf(planeShape()).empty());
    EXPECT_TRUE(outlinesOf(boxShape({0.5, 0.5, 0.5})).empty());
    for (const char* kind : {"sphere", "capsule", "cylinder", "cone"})
        EXPECT_TRUE(outlinesOf(roundShape(kind, 0.3)).empty()) << kind;
}

TEST(CollisionOutline, PartsOfACompoundStandInTheirPlaces) {
    SizedShape both;
    both.kind = "compound";
    both.parts = {{roundShape("sphere", 0.1), {{1, 2, 3}, {1, 0, 0, 0}}},
                  {boxHull({0.1, 0.2, 0.3}), {{0, 1, 0}, turned({0, 0, 1}, core::pi / 2)}}};
    const std::vector<Outline> outlines = outlinesOf(both);
    ASSERT_EQ(outlines.size(), 1u);
    for (const glm::dvec3& v : outlines[0].vertices) {
        EXPECT_NEAR(std::abs(v.x), 0.2, 1e-15);
        EXPECT_NEAR(std::abs(v.y - 1), 0.1, 1e-15);
    }
}

}  // namespace
}  // namespace taut::collision
