#include "taut/contact/crossings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "taut/contact/closest.h"

namespace taut::contact {
namespace {

constexpr double leastSlope = 0.05;  // of an edge against the triangle, for its faces to have a say

dvec3 unit(const dvec3& v) {
    const double size = length(v);
    return size > 0 ? v / size : dvec3(0.0);
}

// Volino and Magnenat-Thalmann, "Resolving surface collisions through intersection contour minimization", 2006.
dvec3 wayApart(const Elements& elements, const Edge& edge, const Triangle& triangle, std::span<const dvec3> x) {
    const auto at = [&](int i) { return x[static_cast<std::size_t>(i)]; };
    if (elements.isRigid(edge.surface)) return -outOfEdge(edge, triangle, x);
    const dvec3 along = unit(at(edge.b) - at(edge.a));
    const std::array<int, 3>& c = triangle.points;
    const dvec3 normal = unit(glm::cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0])));
    const double slope = glm::dot(along, normal);
    if (std::abs(slope) < leastSlope) return dvec3(0.0);
    dvec3 sum(0.0);
    for (int t : edge.triangles) {
        if (t < 0) continue;
        const std::array<int, 3>& f = elements.triangles()[static_cast<std::size_t>(t)].points;
        int apex = f[0];
        for (int i : f)
            if (i != edge.a && i != edge.b) apex = i;
        const dvec3 face = glm::cross(at(f[1]) - at(f[0]), at(f[2]) - at(f[0]));
        dvec3 line = unit(glm::cross(face, normal));  // of the two planes, to be led into the face
        const dvec3 inwards = at(apex) - at(edge.a);
        const dvec3 across = inwards - glm::dot(inwards, along) * along;
        if (glm::dot(line, across) < 0) line = -line;
        sum += line - (2 * glm::dot(along, line) / slope) * normal;
    }
    return sum;
}

// Two triangles that cut each other do so along a line from one crossing to the next: those are of one contour, and
// the sides of an edge in one of them are the other way round in the other. All of a contour goes the same way, or the
// middle of a straight one would have none, and its ends only draw their surface together.
void agreeOnWays(const Elements& elements, std::vector<Crossing>& crossings) {
    struct Link {
        int low, high;  // triangles
        int crossing;
        bool isLow;  // the edge is of the lower
    };
    std::vector<Link> links;
    for (std::size_t c = 0; c < crossings.size(); ++c)
        for (int t : elements.edges()[static_cast<std::size_t>(crossings[c].edge)].triangles)
            if (t >= 0)
                links.push_back({std::min(t, crossings[c].triangle), std::max(t, crossings[c].triangle),
                                 static_cast<int>(c), t < crossings[c].triangle});
    std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
        return std::tie(a.low, a.high, a.crossing) < std::tie(b.low, b.high, b.crossing);
    });
    std::vector<int> parent(crossings.size());
    std::vector<char> isOther(crossings.size(), 0);  // way round than the parent
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&](int c) {
        bool other = false;
        while (parent[static_cast<std::size_t>(c)] != c) {
            other = other != (isOther[static_cast<std::size_t>(c)] != 0);
            c = parent[static_cast<std::size_t>(c)];
        }
        return std::pair(c, other);
    };
    for (std::size_t k = 1; k < links.size(); ++k) {
        if (links[k].low != links[k - 1].low || links[k].high != links[k - 1].high) continue;
        const auto [a, otherA] = find(links[k - 1].crossing);
        const auto [b, otherB] = find(links[k].crossing);
        if (a == b) continue;
        const bool differ = (otherA != otherB) != (links[k].isLow != links[k - 1].isLow);
        parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        isOther[static_cast<std::size_t>(std::max(a, b))] = differ ? 1 : 0;
    }
    std::vector<dvec3> sums(crossings.size(), dvec3(0.0));
    for (std::size_t c = 0; c < crossings.size(); ++c) {
        const auto [root, other] = find(static_cast<int>(c));
        sums[static_cast<std::size_t>(root)] += other ? -crossings[c].apart : crossings[c].apart;
    }
    for (std::size_t c = 0; c < crossings.size(); ++c) {
        const auto [root, other] = find(static_cast<int>(c));
        const dvec3 way = unit(sums[static_cast<std::size_t>(root)]);
        crossings[c].apart = other ? -way : way;
    }
}

}  // namespace

dvec3 acrossEdge(const Edge& edge, int beside, std::span<const dvec3> x) {
    const dvec3& from = x[static_cast<std::size_t>(edge.a)];
    const dvec3 along = x[static_cast<std::size_t>(edge.b)] - from, way = x[static_cast<std::size_t>(beside)] - from;
    return unit(way - (glm::dot(way, along) / glm::dot(along, along)) * along);
}

dvec3 outOfEdge(const Edge& edge, const Triangle& triangle, std::span<const dvec3> x) {
    const std::array<int, 3>& c = triangle.points;
    const auto at = [&](int i) { return x[static_cast<std::size_t>(i)]; };
    const dvec3 normal = unit(glm::cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0])));
    if (edge.wings[0] < 0 || edge.wings[1] < 0) return dvec3(0.0);
    const double out = -glm::dot(normal, acrossEdge(edge, edge.wings[0], x) + acrossEdge(edge, edge.wings[1], x));
    return out < 0 ? -normal : normal;
}

std::vector<Crossing> findCrossings(const Elements& elements, Patches& patches, std::span<const dvec3> x) {
    std::vector<Crossing> crossings;
    patches.start(x, x);
    patches.followAll(x, x);
    std::vector<Box> boxes;
    for (int p = 0; p < patches.count(); ++p) boxes.push_back(patches.motion(p).box);
    std::vector<PatchPair> near;
    patches.findNear(boxes, 0.0, near);
    const auto at = [&](int i) -> const dvec3& { return x[static_cast<std::size_t>(i)]; };
    struct Boxed {
        int item;
        Box box;
    };
    std::vector<Boxed> edges;
    const auto tryBoth = [&](const Patch& ofEdges, const Patch& ofTriangles, const Box& edgeBox,
                             const Box& triangleBox) {
        edges.clear();
        for (int e : ofEdges.edges) {
            const Edge& edge = elements.edges()[static_cast<std::size_t>(e)];
            if (edge.isGone || edge.a == edge.b) continue;
            // What is round, or has one face, has no side that is out.
            if (elements.isRigid(edge.surface) && (edge.wings[0] < 0 || edge.wings[1] < 0)) continue;
            Box box;
            box.add(at(edge.a));
            box.add(at(edge.b));
            if (box.overlaps(triangleBox, 0.0)) edges.push_back({e, box});
        }
        if (edges.empty()) return;
        for (int t : ofTriangles.triangles) {
            const Triangle& triangle = elements.triangles()[static_cast<std::size_t>(t)];
            if (triangle.isGone) continue;
            const std::array<int, 3>& c = triangle.points;
            Box box;
            for (int i : c) box.add(at(i));
            if (!box.overlaps(edgeBox, 0.0)) continue;
            for (const Boxed& boxed : edges) {
                if (!boxed.box.overlaps(box, 0.0)) continue;
                const Edge& edge = elements.edges()[static_cast<std::size_t>(boxed.item)];
                if (edge.a == c[0] || edge.a == c[1] || edge.a == c[2] || edge.b == c[0] || edge.b == c[1] ||
                    edge.b == c[2])
                    continue;
                Piercing p;
                if (!pierces(at(edge.a), at(edge.b), at(c[0]), at(c[1]), at(c[2]), p)) continue;
                crossings.push_back({boxed.item,
                                     t,
                                     at(edge.a) + p.s * (at(edge.b) - at(edge.a)),
                                     {edge.a, edge.b, c[0], c[1], c[2]},
                                     {1 - p.s, p.s, -p.weights[0], -p.weights[1], -p.weights[2]},
                                     wayApart(elements, edge, triangle, x)});
            }
        }
    };
    for (PatchPair pair : near) {
        const int a = lowOf(pair), b = highOf(pair);
        const Box &boxA = patches.motion(a).box, &boxB = patches.motion(b).box;
        tryBoth(patches[a], patches[b], boxA, boxB);
        if (a != b) tryBoth(patches[b], patches[a], boxB, boxA);
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return a.edge < b.edge || (a.edge == b.edge && a.triangle < b.triangle);
    });
    agreeOnWays(elements, crossings);
    return crossings;
}

}  // namespace taut::contact
