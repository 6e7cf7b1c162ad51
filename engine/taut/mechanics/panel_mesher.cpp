#include "taut/mechanics/panel_mesher.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/mechanics/private/triangulation.h"

namespace taut::mechanics {
namespace {

using glm::dvec2;

constexpr double mostPoints = 1e6;
constexpr std::size_t mostCorners = 4000;
constexpr double leastSide = 0.5;  // cells
constexpr double leastGap = 0.1;   // [cells] between sides that do not follow each other
constexpr double leastTurn = 0.1;  // sine of the angle between two sides: 6°
constexpr double nearest = 0.6;    // [cells] that points inside keep from the outline
constexpr int rounds = 6;          // of relaxation; further ones change little

double turned(const dvec2& a, const dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

struct Side {
    dvec2 a, b;
    int ring = 0, corner = 0;
};

double squaredDistance(const dvec2& p, const Side& side) {
    const dvec2 way = side.b - side.a;
    const double along = glm::clamp(glm::dot(p - side.a, way) / glm::dot(way, way), 0.0, 1.0);
    const dvec2 rest = p - (side.a + along * way);
    return glm::dot(rest, rest);
}

bool doCross(const Side& one, const Side& other) {
    // Of sides on one line, rounding says which ends are on which side of the other.
    const auto isBefore = [](const Side& side, const Side& of) {
        return glm::any(glm::lessThan(glm::max(side.a, side.b), glm::min(of.a, of.b)));
    };
    if (isBefore(one, other) || isBefore(other, one)) return false;
    const auto separates = [](const Side& side, const Side& of) {
        return (turned(side.b - side.a, of.a - side.a) > 0) != (turned(side.b - side.a, of.b - side.a) > 0);
    };
    return separates(one, other) && separates(other, one);
}

bool areNear(const Side& one, const Side& other, double gap) {
    return doCross(one, other) || std::min({squaredDistance(one.a, other), squaredDistance(one.b, other),
                                            squaredDistance(other.a, one), squaredDistance(other.b, one)}) < gap * gap;
}

std::vector<Side> sidesOf(const PanelShape& shape) {
    std::vector<Side> sides;
    for (std::size_t ring = 0; ring < shape.rings.size(); ++ring) {
        const std::vector<dvec2>& corners = shape.rings[ring];
        if (corners.size() < 3) throw PanelFault("an outline has at least 3 corners", static_cast<int>(ring), -1);
        for (std::size_t i = 0; i < corners.size(); ++i)
            sides.push_back(
                {corners[i], corners[(i + 1) % corners.size()], static_cast<int>(ring), static_cast<int>(i)});
    }
    if (sides.size() > mostCorners)
        throw PanelFault("the outlines have more than " + std::to_string(mostCorners) + " corners", 0, -1);
    return sides;
}

std::string nameOf(const Side& side) {
    return "side " + std::to_string(side.corner) + (side.ring > 0 ? " of hole " + std::to_string(side.ring - 1) : "");
}

// The side that ends where this one begins.
const Side& before(const std::vector<Side>& sides, std::size_t i, const PanelShape& shape) {
    const std::size_t count = shape.rings[sides[i].ring].size();
    return sides[sides[i].corner > 0 ? i - 1 : i + count - 1];
}

bool isInside(const dvec2& p, const std::vector<Side>& sides, int ring) {
    bool isIn = false;
    for (const Side& side : sides)
        if (side.ring == ring && (side.a.y > p.y) != (side.b.y > p.y) &&
            p.x < side.a.x + (p.y - side.a.y) / (side.b.y - side.a.y) * (side.b.x - side.a.x))
            isIn = !isIn;
    return isIn;
}

void check(const PanelShape& shape, const std::vector<Side>& sides) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Side &side = sides[i], &last = before(sides, i, shape);
        const dvec2 way = side.b - side.a, back = last.a - last.b;
        if (way == dvec2(0.0))
            throw PanelFault("this corner and the next are the same point: leave one out", side.ring, side.corner);
        if (glm::length(way) < leastSide * shape.cell)
            throw PanelFault(nameOf(side) + " is shorter than half a cell: leave corners out, or make cells smaller",
                             side.ring, side.corner);
        if (glm::dot(way, back) > 0 && std::abs(turned(way, back)) < leastTurn * glm::length(way) * glm::length(back))
            throw PanelFault("the outline turns back here in a spike below 6°: leave this corner out", side.ring,
                             side.corner);
    }
    for (std::size_t i = 0; i < sides.size(); ++i)
        for (std::size_t j = i + 1; j < sides.size(); ++j)
            if (&before(sides, j, shape) != &sides[i] && &before(sides, i, shape) != &sides[j] &&
                areNear(sides[i], sides[j], leastGap * shape.cell))
                throw PanelFault(nameOf(sides[i]) + " and " + nameOf(sides[j]) +
                                     " cross or come nearer than a tenth of a cell: an outline goes round once and "
                                     "does not meet itself or a hole",
                                 sides[j].ring, sides[j].corner);
    for (std::size_t hole = 1; hole < shape.rings.size(); ++hole)
        for (std::size_t other = 0; other < shape.rings.size(); ++other)
            if (other != hole && isInside(shape.rings[hole].front(), sides, static_cast<int>(other)) != (other == 0))
                throw PanelFault(other == 0 ? "this hole lies outside of the outline"
                                            : "this hole lies inside of hole " + std::to_string(other - 1),
                                 static_cast<int>(hole), 0);
}

void addOutline(const PanelShape& shape, const std::vector<Side>& sides, PanelMesh& mesh) {
    mesh.corners.resize(shape.rings.size());
    for (const Side& side : sides) {
        mesh.corners[side.ring].push_back(static_cast<int>(mesh.points.size()));
        const auto ring = static_cast<std::size_t>(side.ring), corner = static_cast<std::size_t>(side.corner);
        const bool isGiven =
            ring < shape.edges.size() && corner < shape.edges[ring].size() && shape.edges[ring][corner] > 0;
        const double edges = isGiven ? shape.edges[ring][corner]
                                     : std::max(1.0, std::floor(glm::length(side.b - side.a) / shape.cell + 0.5));
        for (int i = 0; i < edges; ++i) mesh.points.push_back(side.a + (i / edges) * (side.b - side.a));
    }
    mesh.outlinePoints = static_cast<int>(mesh.points.size());
}

// Rows of equilateral triangles from the middle of the panel, without points outside or near the outline.
void addInside(const PanelShape& shape, const std::vector<Side>& sides, PanelMesh& mesh) {
    const dvec2 along = shape.along, up(-along.y, along.x);
    // As seen with the rows level.
    std::vector<Side> level;
    dvec2 low(0.0), high(0.0);
    for (const Side& side : sides) {
        const auto levelled = [&](const dvec2& p) { return dvec2(glm::dot(p, along), glm::dot(p, up)); };
        level.push_back({levelled(side.a), levelled(side.b)});
        low = level.size() == 1 ? level.back().a : glm::min(low, level.back().a);
        high = level.size() == 1 ? level.back().a : glm::max(high, level.back().a);
    }
    const dvec2 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const double height = std::sqrt(0.75) * shape.cell, reach = nearest * shape.cell;
    const int rows = static_cast<int>(std::floor(half.y / height));
    const int columns = static_cast<int>(std::floor(half.x / shape.cell)) + 1;
    for (int row = -rows; row <= rows; ++row) {
        const double v = middle.y + row * height;
        std::vector<Side> near;
        for (const Side& side : level)
            if (std::min(side.a.y, side.b.y) <= v + reach && std::max(side.a.y, side.b.y) >= v - reach)
                near.push_back(side);
        for (int column = -columns; column <= columns; ++column) {
            const dvec2 p(middle.x + (column + (row % 2 != 0 ? 0.5 : 0.0)) * shape.cell, v);
            const bool isClear = std::all_of(
                near.begin(), near.end(), [&](const Side& side) { return squaredDistance(p, side) >= reach * reach; });
            if (isClear && isInside(p, near, 0)) mesh.points.push_back(p.x * along + p.y * up);
        }
    }
}

}  // namespace

PanelMesh meshPanel(const PanelShape& shape) {
    const std::vector<Side> sides = sidesOf(shape);
    dvec2 low = sides.front().a, high = low;
    double length = 0;
    for (const Side& side : sides) {
        low = glm::min(low, side.a);
        high = glm::max(high, side.a);
        length += glm::length(side.b - side.a);
    }
    const dvec2 size = high - low;
    // Of the square that holds the panel however its rows lie.
    if (glm::dot(size, size) / (shape.cell * shape.cell) + length / shape.cell > mostPoints)
        throw PanelFault("so small cells make more than a million points: make them larger", 0, -1);
    check(shape, sides);

    PanelMesh mesh;
    addOutline(shape, sides, mesh);
    addInside(shape, sides, mesh);
    Triangulation triangulation(mesh.points, low, std::max(size.x, size.y));
    std::vector<int> next;
    for (std::size_t ring = 0; ring < mesh.corners.size(); ++ring)
        while (static_cast<int>(next.size()) < mesh.ringEnd(ring))
            next.push_back(static_cast<int>(next.size()) + 1 < mesh.ringEnd(ring) ? static_cast<int>(next.size()) + 1
                                                                                  : mesh.corners[ring].front());
    triangulation.keepRings(std::move(next));
    for (int i = 0; i < rounds; ++i) triangulation.relax(mesh.points);
    mesh.triangles = triangulation.triangles();
    return mesh;
}

}  // namespace taut::mechanics
