#include "taut/contact/elements.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <numeric>

#include "taut/contact/closest_points.h"

namespace taut::contact {

Elements::Elements(std::vector<ContactSurface> surfaces, std::vector<dvec3> rest)
    : surfaces_(std::move(surfaces)),
      apart_(surfaces_.size()),
      rest_(std::move(rest)),
      surfaceOf_(rest_.size(), -1),
      oneOf_(rest_.size()),
      isStill_(surfaces_.size(), 0),
      meetsAny_(surfaces_.size(), 0) {
    std::iota(oneOf_.begin(), oneOf_.end(), 0);
    const int count = static_cast<int>(surfaces_.size());
    for (int s = 0; s < count; ++s)
        for (int other = 0; other < count && meetsAny_[static_cast<std::size_t>(s)] == 0; ++other)
            meetsAny_[static_cast<std::size_t>(s)] =
                surfaces_[static_cast<std::size_t>(s)].meetsShapes || mayMeet(s, other) ? 1 : 0;
    for (int s = 0; s < count; ++s) addSurface(s);
    firstTriangleOf_.push_back(triangles_.size());
    firstEdgeOf_.push_back(edges_.size());
    firstBall_ = static_cast<int>(edges_.size());
    isSevered_.assign(edges_.size(), false);
    refresh();
}

void Elements::addSurface(int number) {
    const ContactSurface& surface = surfaces_[static_cast<std::size_t>(number)];
    for (int i : surface.points) {
        int& owner = surfaceOf_[static_cast<std::size_t>(i)];
        if (owner < 0) owner = number;
    }
    firstTriangleOf_.push_back(triangles_.size());
    firstEdgeOf_.push_back(edges_.size());
    if (!meetsAny(number)) {
        shortest_.push_back(0.0);
        longest_.push_back(0.0);
        return;
    }
    std::map<std::array<int, 2>, int> known;
    const auto edgeOf = [&](int a, int b, bool isLine) {
        const auto [place, isNew] =
            known.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(edges_.size()));
        if (isNew) edges_.push_back({std::min(a, b), std::max(a, b), number, isLine});
        return place->second;
    };
    for (const std::array<int, 3>& t : surface.triangles)
        triangles_.push_back(
            {t, {edgeOf(t[0], t[1], false), edgeOf(t[1], t[2], false), edgeOf(t[2], t[0], false)}, number});
    for (std::size_t l = 0; l < surface.lines.size(); ++l) {
        const std::array<int, 2>& line = surface.lines[l];
        if (line[0] == line[1]) continue;
        const auto e = static_cast<std::size_t>(edgeOf(line[0], line[1], true));
        if (l < surface.wings.size()) edges_[e].wings = surface.wings[l];
    }
    double shortest = std::numeric_limits<double>::infinity(), longest = 0;
    for (std::size_t e = firstEdgeOf_.back(); e < edges_.size(); ++e) {
        const dvec3 d = rest_[static_cast<std::size_t>(edges_[e].b)] - rest_[static_cast<std::size_t>(edges_[e].a)];
        shortest = std::min(shortest, std::sqrt(glm::dot(d, d)));
        longest = std::max(longest, std::sqrt(glm::dot(d, d)));
    }
    shortest_.push_back(std::isfinite(shortest) ? shortest : 0.0);
    longest_.push_back(longest);
}

double Elements::thicknessOf(const std::array<int, 4>& points, bool isPoint) const {
    const int a = surfaceOf(points[0]), b = surfaceOf(points[3]);
    const double thickness = surface(a).thickness + surface(b).thickness;
    if (!shareBond(a, b)) return thickness;
    Corners rest;
    for (std::size_t k = 0; k < 4; ++k) rest[k] = rest_[static_cast<std::size_t>(points[k])];
    const double far = thickness / restShare + longestEdge(b) + (isPoint ? 0.0 : longestEdge(a));
    const dvec3 between = rest[0] - rest[2];
    if (glm::dot(between, between) > far * far) return thickness;
    return std::min(thickness, restShare * length(closestPoints(rest, isPoint).separation));
}

void Elements::setGone(int number, const std::function<bool(std::size_t triangle)>& isTriangleGone,
                       const std::function<bool(int a, int b)>& isEdgeSevered) {
    const auto s = static_cast<std::size_t>(number);
    for (std::size_t t = firstTriangleOf_[s]; t < firstTriangleOf_[s + 1]; ++t)
        triangles_[t].isGone = isTriangleGone(t - firstTriangleOf_[s]);
    for (std::size_t e = firstEdgeOf_[s]; e < firstEdgeOf_[s + 1]; ++e)
        isSevered_[e] = isEdgeSevered(edges_[e].a, edges_[e].b);
}

void Elements::sew(int a, int b) {
    const int first = oneOf_[static_cast<std::size_t>(a)], second = oneOf_[static_cast<std::size_t>(b)];
    std::replace(oneOf_.begin(), oneOf_.end(), std::max(first, second), std::min(first, second));
}

void Elements::keepApart(int surfaceA, int surfaceB) {
    if (surfaceA == surfaceB || !mayTouch(surfaceA, surfaceB)) return;
    apart_[static_cast<std::size_t>(surfaceA)].push_back(surfaceB);
    apart_[static_cast<std::size_t>(surfaceB)].push_back(surfaceA);
}

void Elements::refresh() {
    // The first triangle at each point, and the triangles beside each edge. A crowded edge has more than two.
    edges_.resize(static_cast<std::size_t>(firstBall_));
    firstTriangle_.assign(rest_.size(), -1);
    for (std::size_t e = 0; e < edges_.size(); ++e) edges_[e].triangles = {-1, -1};
    std::vector<bool> isCrowded(edges_.size(), false);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (triangles_[t].isGone) continue;
        for (int i : triangles_[t].points) {
            int& first = firstTriangle_[static_cast<std::size_t>(i)];
            if (first < 0) first = static_cast<int>(t);
        }
        for (int e : triangles_[t].edges) {
            std::array<int, 2>& beside = edges_[static_cast<std::size_t>(e)].triangles;
            if (beside[0] < 0)
                beside[0] = static_cast<int>(t);
            else if (beside[1] < 0)
                beside[1] = static_cast<int>(t);
            else
                isCrowded[static_cast<std::size_t>(e)] = true;
        }
    }
    // Which edges are gone, and how many edges each point has left.
    std::vector<int> degree(rest_.size() + 1, 0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        Edge& edge = edges_[e];
        if (isCrowded[e]) edge.triangles[1] = -1;
        edge.isGone = edge.triangles[0] < 0 && isSevered_[e];
        if (edge.isGone) continue;
        ++degree[static_cast<std::size_t>(edge.a)];
        ++degree[static_cast<std::size_t>(edge.b)];
    }
    // The neighbours of each point.
    ringStart_.assign(rest_.size() + 1, 0);
    for (std::size_t i = 0; i < rest_.size(); ++i)
        ringStart_[i + 1] = ringStart_[i] + static_cast<std::size_t>(degree[i]);
    ring_.assign(ringStart_.back(), 0);
    std::vector<std::size_t> next(ringStart_.begin(), ringStart_.end() - 1);
    for (const Edge& edge : edges_) {
        if (edge.isGone) continue;
        ring_[next[static_cast<std::size_t>(edge.a)]++] = edge.b;
        ring_[next[static_cast<std::size_t>(edge.b)]++] = edge.a;
    }
    // A point without edges becomes a ball: an edge with both ends at the point.
    for (int s = 0; s < static_cast<int>(surfaces_.size()); ++s) {
        if (!meetsAny(s)) continue;
        for (int i : surface(s).points)
            if (degree[static_cast<std::size_t>(i)] == 0 && surfaceOf(i) == s) edges_.push_back({i, i, s, true});
    }
}

std::uint64_t Elements::bytes() const {
    return triangles_.size() * sizeof(Triangle) + edges_.size() * sizeof(Edge) + ring_.size() * sizeof(int) +
           rest_.size() * (sizeof(dvec3) + 4 * sizeof(int));
}

}  // namespace taut::contact
