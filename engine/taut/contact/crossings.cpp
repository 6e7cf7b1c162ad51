#include "taut/contact/crossings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "taut/contact/closest_points.h"
#include "taut/contact/leaf_boxes.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr int boxedAtOnce = 16;      // leaves per task
constexpr int pairsAtOnce = 64;      // of leaves per task
constexpr double leastSlope = 0.05;  // sine of the angle of edge and triangle; a flatter edge has no direction

dvec3 unit(const dvec3& v) {
    const double size = length(v);
    return size > 0 ? v / size : dvec3(0.0);
}

dvec3 normalOf(const Triangle& triangle, std::span<const dvec3> x) {
    const auto at = [&](int k) { return x[static_cast<std::size_t>(triangle.points[static_cast<std::size_t>(k)])]; };
    return unit(glm::cross(at(1) - at(0), at(2) - at(0)));
}

// The direction in which the contour grows shorter: Volino and Magnenat-Thalmann, "Resolving surface collisions through
// intersection contour minimization", 2006.
dvec3 shortening(const Elements& elements, const Edge& edge, const Triangle& triangle, std::span<const dvec3> x) {
    const auto at = [&](int i) { return x[static_cast<std::size_t>(i)]; };
    if (elements.isRigid(edge.surface)) return -outOfEdge(edge, triangle, x);
    const dvec3 along = unit(at(edge.b) - at(edge.a)), normal = normalOf(triangle, x);
    const double slope = glm::dot(along, normal);
    if (std::abs(slope) < leastSlope) return dvec3(0.0);
    dvec3 sum(0.0);
    for (int t : edge.triangles) {
        if (t < 0) continue;
        const Triangle& own = elements.triangles()[static_cast<std::size_t>(t)];
        int apex = own.points[0];
        for (int i : own.points)
            if (i != edge.a && i != edge.b) apex = i;
        dvec3 line = unit(glm::cross(normalOf(own, x), normal));  // of the two planes, into the face
        const dvec3 inwards = at(apex) - at(edge.a);
        const dvec3 across = inwards - glm::dot(inwards, along) * along;
        if (glm::dot(line, across) < 0) line = -line;
        sum += line - (2 * glm::dot(along, line) / slope) * normal;
    }
    return sum;
}

// A contour has two curves, one for each sheet. This is one of them.
struct Curve {
    int contour;  // number of the contour's lowest crossing
    bool isOther;
    bool operator==(const Curve&) const = default;
    auto operator<=>(const Curve&) const = default;
};

// Finds the curve of each crossing. Two triangles cut each other along a line from one crossing to the next, so these
// two crossings belong to one contour. They are on the same curve if both edges are of the same triangle, else on
// different curves. Union-find: each crossing stores its curve relative to its parent.
std::vector<Curve> findCurves(const Elements& elements, std::span<const Crossing> crossings) {
    struct Link {
        int low, high;  // triangles
        int crossing;
        bool isLow;  // the edge belongs to the lower triangle
    };
    // Each crossing links the triangles of its edge with the triangle that the edge pierces.
    std::vector<Link> links;
    for (std::size_t c = 0; c < crossings.size(); ++c)
        for (int t : elements.edges()[static_cast<std::size_t>(crossings[c].edge)].triangles)
            if (t >= 0)
                links.push_back({std::min(t, crossings[c].triangle), std::max(t, crossings[c].triangle),
                                 static_cast<int>(c), t < crossings[c].triangle});
    std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
        return std::tie(a.low, a.high, a.crossing) < std::tie(b.low, b.high, b.crossing);
    });
    std::vector<Curve> parents;
    for (std::size_t c = 0; c < crossings.size(); ++c) parents.push_back({static_cast<int>(c), false});
    const auto find = [&](int c) {
        Curve curve{c, false};
        for (;;) {
            const Curve& up = parents[static_cast<std::size_t>(curve.contour)];
            if (up.contour == curve.contour) return curve;
            curve = {up.contour, curve.isOther != up.isOther};
        }
    };
    // Two links with the same two triangles join their crossings.
    for (std::size_t k = 1; k < links.size(); ++k) {
        if (links[k].low != links[k - 1].low || links[k].high != links[k - 1].high) continue;
        const Curve a = find(links[k - 1].crossing), b = find(links[k].crossing);
        if (a.contour == b.contour) continue;
        const bool differ = (a.isOther != b.isOther) != (links[k].isLow != links[k - 1].isLow);
        parents[static_cast<std::size_t>(std::max(a.contour, b.contour))] = {std::min(a.contour, b.contour), differ};
    }
    std::vector<Curve> curves;
    for (std::size_t c = 0; c < crossings.size(); ++c) curves.push_back(find(static_cast<int>(c)));
    return curves;
}

// An edge by its two points, the lower first.
using Cut = std::pair<int, int>;

// The points (ascending) on the smaller side of the cuts (ascending) through a surface; none if the cuts do not part
// it. One flood fill starts at each end of the first cut. The fill with less area at rest goes on, so the cost is that
// of the smaller side.
std::vector<int> smallerSide(const Elements& elements, std::span<const Cut> cuts, std::vector<char>& sideOf) {
    std::array<std::vector<int>, 2> sides{std::vector{cuts[0].first}, std::vector{cuts[0].second}};
    std::array<std::size_t, 2> done{0, 0};
    std::array<double, 2> areas{0, 0};
    bool parts = true;
    std::size_t own = 0;
    const auto markOf = [&](int i) -> char& { return sideOf[static_cast<std::size_t>(i)]; };
    for (std::size_t k : {0U, 1U}) markOf(sides[k][0]) = static_cast<char>(k + 1);
    while (parts) {
        own = areas[0] <= areas[1] ? 0 : 1;
        if (done[own] == sides[own].size()) break;
        const int i = sides[own][done[own]++];
        for (int j : elements.neighbours(i)) {
            const dvec3 way =
                elements.rest()[static_cast<std::size_t>(j)] - elements.rest()[static_cast<std::size_t>(i)];
            areas[own] += glm::dot(way, way);
            if (std::binary_search(cuts.begin(), cuts.end(), Cut(std::min(i, j), std::max(i, j)))) continue;
            if (markOf(j) == 0) {
                markOf(j) = static_cast<char>(own + 1);
                sides[own].push_back(j);
            }
            parts = parts && markOf(j) == static_cast<char>(own + 1);
        }
    }
    for (const std::vector<int>& side : sides)
        for (int i : side) markOf(i) = 0;
    if (!parts) return {};
    std::sort(sides[own].begin(), sides[own].end());
    return sides[own];
}

// The curve (crossings) cuts edges of one sheet. Returns the points of the part of that sheet that went through, see
// smallerSide().
std::vector<int> partThrough(const Elements& elements, std::span<const int> curve, std::span<const Crossing> crossings,
                             std::vector<char>& sideOf) {
    std::vector<Cut> cuts;
    for (int c : curve) {
        const Edge& edge = elements.edges()[static_cast<std::size_t>(crossings[static_cast<std::size_t>(c)].edge)];
        if (elements.isRigid(edge.surface)) return {};
        // An edge that the curve crosses there and back is not cut.
        if (const Cut cut(edge.a, edge.b); !cuts.empty() && cuts.back() == cut)
            cuts.pop_back();
        else
            cuts.push_back(cut);
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts.empty() ? std::vector<int>{} : smallerSide(elements, cuts, sideOf);
}

// The normal of the triangle, turned so that the end that went through comes back. Zero if both ends went through, or
// neither.
dvec3 wayBack(const Crossing& crossing, const Triangle& triangle, std::span<const dvec3> x) {
    if (crossing.areThrough[0] == crossing.areThrough[1]) return dvec3(0.0);
    const dvec3 normal = normalOf(triangle, x);
    const dvec3 ahead =
        x[static_cast<std::size_t>(crossing.points[1])] - x[static_cast<std::size_t>(crossing.points[0])];
    return (glm::dot(ahead, normal) > 0) == crossing.areThrough[0] ? normal : -normal;
}

// Finds for each contour which part went through, and one direction for all its crossings.
void findWaysApart(const Elements& elements, std::span<const dvec3> x, std::vector<Crossing>& crossings) {
    const std::vector<Curve> curves = findCurves(elements, crossings);
    std::vector<int> order(crossings.size());
    std::iota(order.begin(), order.end(), 0);
    const auto curveOf = [&](int c) { return curves[static_cast<std::size_t>(c)]; };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return curveOf(a) < curveOf(b); });
    std::vector<char> sideOf(x.size(), 0);
    for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
        // A contour is order[first, last). Its two curves meet at middle.
        std::size_t middle = first;
        while (middle < order.size() && curveOf(order[middle]) == curveOf(order[first])) ++middle;
        last = middle;
        while (last < order.size() && curveOf(order[last]).contour == curveOf(order[first]).contour) ++last;
        const std::span all(order);
        // The part that went through, of the sheet whose edges are on the first curve, and of the other sheet.
        std::array parts{partThrough(elements, all.subspan(first, middle - first), crossings, sideOf),
                         partThrough(elements, all.subspan(middle, last - middle), crossings, sideOf)};
        const bool isParted = !parts[0].empty() || !parts[1].empty();
        // The direction of each crossing, and their sum as seen from the first curve.
        dvec3 sum(0.0);
        for (std::size_t k = first; k < last; ++k) {
            Crossing& crossing = crossings[static_cast<std::size_t>(order[k])];
            const Edge& edge = elements.edges()[static_cast<std::size_t>(crossing.edge)];
            const Triangle& triangle = elements.triangles()[static_cast<std::size_t>(crossing.triangle)];
            for (std::size_t i = 0; i < 5; ++i) {
                const std::vector<int>& part = parts[(i < 2) == (k < middle) ? 0 : 1];
                crossing.areThrough[i] = !isParted || std::binary_search(part.begin(), part.end(), crossing.points[i]);
            }
            crossing.separatingDirection =
                isParted ? wayBack(crossing, triangle, x) : shortening(elements, edge, triangle, x);
            sum += curveOf(order[k]).isOther ? -crossing.separatingDirection : crossing.separatingDirection;
        }
        // All crossings get the mean direction, reversed on the other curve.
        const dvec3 way = unit(sum);
        for (std::size_t k = first; k < last; ++k)
            crossings[static_cast<std::size_t>(order[k])].separatingDirection = curveOf(order[k]).isOther ? -way : way;
    }
}

}  // namespace

dvec3 acrossEdge(const Edge& edge, int beside, std::span<const dvec3> x) {
    const dvec3& from = x[static_cast<std::size_t>(edge.a)];
    const dvec3 along = x[static_cast<std::size_t>(edge.b)] - from, way = x[static_cast<std::size_t>(beside)] - from;
    return unit(way - (glm::dot(way, along) / glm::dot(along, along)) * along);
}

dvec3 outOfEdge(const Edge& edge, const Triangle& triangle, std::span<const dvec3> x) {
    const dvec3 normal = normalOf(triangle, x);
    if (edge.wings[0] < 0 || edge.wings[1] < 0) return dvec3(0.0);
    const double out = -glm::dot(normal, acrossEdge(edge, edge.wings[0], x) + acrossEdge(edge, edge.wings[1], x));
    return out < 0 ? -normal : normal;
}

std::vector<Crossing> findCrossings(const Elements& elements, Bvh& leaves, std::span<const dvec3> x) {
    const auto at = [&](int i) -> const dvec3& { return x[static_cast<std::size_t>(i)]; };
    // A rigid edge with fewer than two faces has no outer side.
    const auto mayPierce = [&](const Edge& edge) {
        return edge.a != edge.b && (!elements.isRigid(edge.surface) || (edge.wings[0] >= 0 && edge.wings[1] >= 0));
    };
    const auto test = [&](int e, int t, std::vector<Crossing>& found) {
        const Edge& edge = elements.edges()[static_cast<std::size_t>(e)];
        const Triangle& triangle = elements.triangles()[static_cast<std::size_t>(t)];
        const std::array<int, 3>& c = triangle.points;
        Piercing p;
        if (!mayPierce(edge)) return;
        if (elements.areNeighbours(edge.a, triangle) || elements.areNeighbours(edge.b, triangle)) return;
        if (!pierces(at(edge.a), at(edge.b), at(c[0]), at(c[1]), at(c[2]), p)) return;
        found.push_back({e,
                         t,
                         at(edge.a) + p.s * (at(edge.b) - at(edge.a)),
                         {edge.a, edge.b, c[0], c[1], c[2]},
                         {1 - p.s, p.s, -p.weights[0], -p.weights[1], -p.weights[2]},
                         dvec3(0.0),
                         {}});
    };
    // All pairs of leaves, then sorted so that the order does not depend on the tree, nor on threads.
    std::vector<LeafBoxes> boxes(static_cast<std::size_t>(leaves.count()));
    core::parallelFor(leaves.count(), boxedAtOnce,
                      [&](int p) { boxes[static_cast<std::size_t>(p)].find(elements, leaves[p], x, x, dvec3(0.0)); });
    std::vector<LeafPair> near;
    leaves.fit(x, x);
    leaves.findNear(near);
    std::vector<std::vector<Crossing>> perPair(near.size());
    core::parallelFor(static_cast<int>(near.size()), pairsAtOnce, [&](int k) {
        std::vector<Crossing>& found = perPair[static_cast<std::size_t>(k)];
        BoxQuery query;
        const int a = lowOf(near[static_cast<std::size_t>(k)]), b = highOf(near[static_cast<std::size_t>(k)]);
        const auto pierce = [&](int ofEdges, int ofTriangles) {
            const LeafBoxes &own = boxes[static_cast<std::size_t>(ofEdges)],
                            &other = boxes[static_cast<std::size_t>(ofTriangles)];
            for (const auto& [e, t] : query.find(0.0, own.edges, own.whole, other.triangles, other.whole, dvec3(0.0)))
                test(e, t, found);
        };
        pierce(a, b);
        if (a != b) pierce(b, a);
    });
    std::vector<Crossing> crossings;
    for (const std::vector<Crossing>& found : perPair) crossings.insert(crossings.end(), found.begin(), found.end());
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return a.edge < b.edge || (a.edge == b.edge && a.triangle < b.triangle);
    });
    findWaysApart(elements, x, crossings);
    return crossings;
}

}  // namespace taut::contact
