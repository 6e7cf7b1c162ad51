#include "taut/mechanics/panel_mesher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>

#include "taut/core/private/hash.h"

namespace taut::mechanics::panels {
namespace {

using glm::dvec2;
using Ring = std::vector<dvec2>;

const Ring square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
const Ring corner{{0, 0}, {1, 0}, {1, 0.4}, {0.4, 0.4}, {0.4, 1}, {0, 1}};  // one of them points inwards
const Ring clockwise{{-0.2, 0.6}, {0.2, 0.6}, {0.45, 0}, {0.2, -0.05}, {-0.2, -0.05}, {-0.45, 0}};
const Ring strip{{0, 0}, {1, 0.3}, {1, 0.4}, {0, 0.1}};
const Ring slot{{0, 0}, {1, 0}, {1, 1}, {0.56, 1}, {0.5, 0.3}, {0.44, 1}, {0, 1}};
const Ring hole{{0.3, 0.3}, {0.6, 0.35}, {0.5, 0.7}};

std::vector<PanelShape> shapes() {
    std::vector<PanelShape> all;
    for (const double cell : {0.09, 0.05, 0.021})
        for (const dvec2 along : {dvec2(1, 0), dvec2(0.8, 0.6)}) {
            for (const Ring& ring : {square, corner, clockwise, slot}) all.push_back({{ring}, cell, along});
            all.push_back({{square, hole}, cell, along});
        }
    all.push_back({{strip}, 0.05});
    return all;
}

double cross(const dvec2& a, const dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

double areaOf(const Ring& ring) {
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) sum += 0.5 * cross(ring[i], ring[(i + 1) % ring.size()]);
    return std::abs(sum);
}

// Calls with the three corners of each triangle, the first of them in turn.
void eachCorner(const PanelMesh& mesh, const std::function<void(int, int, int)>& visit) {
    for (const auto& [a, b, c] : mesh.triangles) {
        visit(a, b, c);
        visit(b, c, a);
        visit(c, a, b);
    }
}

// Every triangle runs counter-clockwise and together they have the panel's area: none lies outside or over another.
TEST(PanelMesher, FillsThePanelOnce) {
    for (const PanelShape& shape : shapes()) {
        const PanelMesh mesh = meshPanel(shape);
        double area = 0, whole = areaOf(shape.rings[0]);
        for (std::size_t i = 1; i < shape.rings.size(); ++i) whole -= areaOf(shape.rings[i]);
        for (const auto& [a, b, c] : mesh.triangles) {
            const auto at = [&](int i) { return mesh.points[i]; };
            const double own = 0.5 * cross(at(b) - at(a), at(c) - at(a));
            EXPECT_GT(own, 0);
            area += own;
        }
        EXPECT_NEAR(area, whole, 1e-12 * whole);  // some thousand roundings
    }
}

// An edge of several sides may lie at any angle, where rounding puts their ends on either side of each other.
TEST(PanelMesher, TakesSidesOnOneLineForApart) {
    for (int turn = 1; turn < 20; ++turn) {
        const dvec2 along(std::cos(0.3 * turn), std::sin(0.3 * turn)), up(-along.y, along.x);
        Ring ring;
        for (int k = 0; k < 6; ++k) ring.push_back((0.17 * k + 0.07) * along + 0.31 * up);
        ring.push_back(0.92 * along + 0.7 * up);
        ring.push_back(0.07 * along + 0.7 * up);
        EXPECT_NO_THROW(meshPanel({{ring}, 0.05})) << turn;
    }
}

// V - E + F = 1 less one for each hole; and edges of only one triangle are the way round the rings, in their order.
TEST(PanelMesher, HasTheOutlineAsItsOnlyBorder) {
    for (const PanelShape& shape : shapes()) {
        const PanelMesh mesh = meshPanel(shape);
        std::map<std::pair<int, int>, int> uses;
        eachCorner(mesh, [&](int a, int b, int) { ++uses[std::minmax(a, b)]; });
        const auto euler = std::ssize(mesh.points) - std::ssize(uses) + std::ssize(mesh.triangles);
        EXPECT_EQ(euler, 2 - std::ssize(shape.rings));
        std::map<std::pair<int, int>, int> border;
        for (std::size_t ring = 0; ring < shape.rings.size(); ++ring) {
            const int first = mesh.corners[ring].front(), end = mesh.ringEnd(ring);
            for (int i = first; i < end; ++i) ++border[std::minmax(i, i + 1 < end ? i + 1 : first)];
            for (std::size_t i = 0; i < shape.rings[ring].size(); ++i)
                EXPECT_EQ(mesh.points[mesh.corners[ring][i]], shape.rings[ring][i]);
        }
        std::erase_if(uses, [](const auto& edge) { return edge.second == 2; });
        EXPECT_EQ(uses, border);
    }
}

// The least angle over all shapes is 28.0°, edges have 0.58 to 1.51 cells. No corner of the shapes is below 60°.
TEST(PanelMesher, KeepsTrianglesFat) {
    for (const PanelShape& shape : shapes()) {
        const PanelMesh mesh = meshPanel(shape);
        eachCorner(mesh, [&](int a, int b, int c) {
            const auto at = [&](int i) { return mesh.points[i]; };
            const dvec2 ab = at(b) - at(a), ac = at(c) - at(a);
            EXPECT_GT(std::atan2(cross(ab, ac), glm::dot(ab, ac)), 25 * M_PI / 180);
            EXPECT_GT(glm::length(ab), 0.5 * shape.cell);
            EXPECT_LT(glm::length(ab), 1.75 * shape.cell);
            if (std::max(a, b) < mesh.outlinePoints && std::abs(a - b) == 1)
                EXPECT_LT(glm::length(ab), 1.5 * shape.cell);
        });
    }
}

// Nine cells inside of the outline edges are those of the rows to 0.2 %, and one side of each triangle has the
// direction of the warp.
TEST(PanelMesher, LaysRowsAlongTheWarp) {
    const PanelShape shape{{square}, 0.04, {0.8, 0.6}};
    const PanelMesh mesh = meshPanel(shape);
    int rows = 0, inner = 0;
    eachCorner(mesh, [&](int a, int b, int c) {
        for (const int i : {a, b, c}) {
            const dvec2 p = mesh.points[i];
            if (std::min({p.x, p.y, 1 - p.x, 1 - p.y}) < 0.36) return;
        }
        const dvec2 ab = mesh.points[b] - mesh.points[a];
        EXPECT_NEAR(glm::length(ab), shape.cell, 4e-3 * shape.cell);
        ++inner;
        if (std::abs(cross(ab, shape.along)) < 4e-3 * shape.cell) ++rows;
    });
    EXPECT_GT(inner, 100);
    EXPECT_EQ(3 * rows, inner);
}

// On every machine and by every compiler.
TEST(PanelMesher, GivesTheSameBits) {
    const PanelMesh mesh = meshPanel({{clockwise, {{-0.1, 0.2}, {0, 0.35}, {0.1, 0.2}}}, 0.03, {0.6, -0.8}});
    core::Hash hash;
    for (const dvec2& p : mesh.points) {
        hash.add(p.x);
        hash.add(p.y);
    }
    for (const auto& triangle : mesh.triangles)
        for (const int i : triangle) hash.add(static_cast<std::uint64_t>(i));
    EXPECT_EQ(hash.value(), 844356642391123141U);
}

TEST(PanelMesher, RefusesWhatIsNoOutline) {
    struct Case {
        std::vector<Ring> rings;
        int ring, corner;
        const char* message;
    };
    const std::vector<Case> cases{
        {{{{0, 0}, {1, 0}}}, 0, -1, "an outline has at least 3 corners"},
        {{{{0, 0}, {1, 0}, {1, 0}, {0, 1}}}, 0, 1, "this corner and the next are the same point: leave one out"},
        {{{{0, 0}, {1, 0}, {1, 0.01}, {0, 1}}},
         0,
         1,
         "side 1 is shorter than half a cell: leave corners out, or make cells smaller"},
        {{{{0, 0}, {1, 0}, {1, 1}, {0.5, 0.02}, {0.45, 1}, {0.4, 0.02}}},
         0,
         0,
         "the outline turns back here in a spike below 6°: leave this corner out"},
        {{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}},
         0,
         2,
         "side 0 and side 2 cross or come nearer than a tenth of a cell: an outline goes round once and does not meet "
         "itself or a hole"},
        {{square, {{0.5, 0.5}, {0.7, 0.5}, {0.6, 1.2}}},
         1,
         1,
         "side 2 and side 1 of hole 0 cross or come nearer than a tenth of a cell: an outline goes round once and does "
         "not meet itself or a hole"},
        {{square, {{2, 2}, {3, 2}, {2, 3}}}, 1, 0, "this hole lies outside of the outline"},
        {{square, {{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}}, {{0.4, 0.3}, {0.6, 0.3}, {0.5, 0.5}}},
         2,
         0,
         "this hole lies inside of hole 0"},
        {{{{0, 0}, {900, 0}, {900, 900}}}, 0, -1, "so small cells make more than a million points: make them larger"}};
    for (const Case& each : cases) {
        try {
            meshPanel({each.rings, 0.05});
            ADD_FAILURE() << each.message;
        } catch (const PanelFault& fault) {
            EXPECT_STREQ(fault.what(), each.message);
            EXPECT_EQ(fault.ring, each.ring) << each.message;
            EXPECT_EQ(fault.corner, each.corner) << each.message;
        }
    }
}

}  // namespace
}  // namespace taut::mechanics::panels
