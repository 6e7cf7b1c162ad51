#include "taut/world/private/drawn_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "taut/core/private/parallel.h"

namespace taut::world {
namespace {

using glm::dvec3;
using Near = collision::Colliders::Near;

constexpr double shareKept = 0.25;  // of the thickness, between the drawn surface and the collider
constexpr double deepest =
    3.0;  // thicknesses; deeper points are there on purpose, for instance if the collider holds them
constexpr int mostPasses = 4;     // each leaves at most 0.4 of the depth, as much as the way out is aslant
constexpr int drawnAtOnce = 256;  // vertices in a task

double easedStep(double from, double to, double x) {
    const double u = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}

// How a vertex goes: by the most that is asked of it, in the mean direction.
struct Push {
    double most = 0.0;  // [m]
    dvec3 direction{0.0};
};

// The displacement that a place needs.
//
//     distance then
//      2k |      /     It stays in place at 2k from the collider and beyond, and ends at k from within,
//       k |--.-'       with no kink between.
//         +--+---+--
//            0   2k   distance now
void ask(const Near& near, double thickness, const glm::vec3& normal, Push& push) {
    const double kept = shareKept * thickness, left = 2.0 * kept - near.distance;
    if (left <= 0.0) return;
    const double depth = -near.distance;
    const double way = (depth > 0.0 ? depth + kept : left * left / (4.0 * kept)) *
                       (1.0 - easedStep(deepest * thickness, (deepest + 1.0) * thickness, depth));
    // Out of a collider's edge the way turns at once from one of its faces to the other; the normal does not.
    const double along = glm::dot(dvec3(normal), near.away), share = easedStep(0.2, 0.6, std::abs(along));
    const dvec3 out = glm::mix(near.away, std::copysign(1.0, along) * dvec3(normal), share);
    push.most = std::max(push.most, way);
    push.direction += way * out;
}

// Calls edge(a, b) for the edges of each triangle.
template <class Edge>
void forEdges(std::span<const std::uint32_t> triangles, const Edge& edge) {
    for (std::size_t i = 0; i < triangles.size(); ++i) edge(triangles[i], triangles[i % 3 == 2 ? i - 2 : i + 1]);
}

// The two earlier vertices between which the last halving put a vertex. Others have none, as none of theirs is earlier.
constexpr std::uint32_t noParent = ~0U;
using Parents = std::array<std::uint32_t, 2>;  // ascending

std::vector<Parents> parentsIn(std::span<const std::uint32_t> triangles, std::size_t vertices) {
    std::vector<Parents> parents(vertices, {noParent, noParent});
    const auto take = [&](std::uint32_t of, std::uint32_t neighbour) {
        auto& [first, second] = parents[of];
        if (neighbour > of || neighbour == first || neighbour >= second) return;
        second = neighbour;
        if (second < first) std::swap(first, second);
    };
    forEdges(triangles, [&](std::uint32_t a, std::uint32_t b) {
        take(a, b);
        take(b, a);
    });
    return parents;
}

// The colliders near the vertices of a sheet. Only every fourth is measured if that suffices for the others.
class NearSheet {
  public:
    NearSheet(const collision::Colliders& colliders, double thickness, std::span<const std::uint32_t> triangles,
              const std::vector<glm::vec3>& positions)
        : colliders_(colliders),
          positions_(positions),
          free_(2.0 * shareKept * thickness),
          parents_(parentsIn(triangles, positions.size())),
          near_(positions.size()) {
        double longest = 0.0;  // [m²]
        forEdges(triangles, [&](std::uint32_t a, std::uint32_t b) {
            const dvec3 way = placeOf(a) - placeOf(b);
            longest = std::max(longest, glm::dot(way, way));
        });
        reach_ = 2.0 * thickness + std::sqrt(longest);
        forVertices([&](std::uint32_t v) {
            if (isFirst(v)) near_[v] = measured(placeOf(v));
        });
        forVertices([&](std::uint32_t v) {
            if (isFirst(v)) return;
            const bool areMeasured = isFirst(parents_[v][0]) && isFirst(parents_[v][1]);
            near_[v] = areMeasured ? amid(parents_[v], placeOf(v)) : measured(placeOf(v));
        });
    }
    const Near& operator[](std::size_t v) const { return near_[v]; }
    // Within reach, so that something may be near between them.
    bool areAll(std::span<const std::uint32_t> vertices) const {
        return std::all_of(
            vertices.begin(), vertices.end(), [&](std::uint32_t v) { return std::isfinite(near_[v].distance); });
    }
    void measureAgain(std::uint32_t v) { near_[v] = measured(placeOf(v)); }  // after it has moved

    // Of a place about in the middle of some vertices; its distance may be larger where nothing is to be done.
    Near amid(std::span<const std::uint32_t> vertices, const dvec3& place) const {
        // Each distance sees a plane. They cannot tell of a place more than how far they part above the middle.
        const double share = 1.0 / static_cast<double>(vertices.size());
        dvec3 middle(0.0);
        for (const std::uint32_t v : vertices) middle += share * placeOf(v);
        double mean = 0.0, parting = 0.0;
        for (const std::uint32_t v : vertices) {
            mean += share * near_[v].distance;
            parting += share * glm::dot(near_[v].away, middle - placeOf(v));
        }
        const double least = mean - std::abs(parting) - glm::distance(place, middle);
        return least > free_ ? Near{least, near_[vertices[0]].away} : measured(place);
    }
    // Of the middle of vertices.
    Near amid(std::span<const std::uint32_t> vertices) const {
        dvec3 middle(0.0);
        for (const std::uint32_t v : vertices) middle += placeOf(v) / static_cast<double>(vertices.size());
        return amid(vertices, middle);
    }

  private:
    bool isFirst(std::uint32_t v) const { return parents_[v][1] == noParent; }
    dvec3 placeOf(std::uint32_t v) const { return dvec3(positions_[v]); }
    Near measured(const dvec3& place) const { return colliders_.nearest(place, reach_); }
    template <class Each>
    void forVertices(const Each& each) {
        core::parallelFor(
            static_cast<int>(near_.size()), drawnAtOnce, [&](int v) { each(static_cast<std::uint32_t>(v)); });
    }

    const collision::Colliders& colliders_;
    const std::vector<glm::vec3>& positions_;
    double free_;       // [m] from a collider, where nothing moves
    double reach_ = 0;  // [m] so far that all triangles of a vertex beyond are free
    std::vector<Parents> parents_;
    std::vector<Near> near_;
};

// Moves the vertices that moved the time before once more; returns whether any did.
bool moveOut(NearSheet& near, double thickness, std::span<const std::uint32_t> triangles, std::vector<char>& isMoved,
             view::Geometry& geometry) {
    std::vector<Push> pushes(isMoved.size());
    for (std::size_t v = 0; v < pushes.size(); ++v)
        if (isMoved[v] != 0) ask(near[v], thickness, geometry.normals[v], pushes[v]);
    // Where corners lie on different faces of a collider, points between them may be inside.
    const auto askAmid = [&](std::span<const std::uint32_t> vertices) {
        const Near found = near.amid(vertices);
        glm::vec3 normal(0.0F);
        for (const std::uint32_t v : vertices) normal += geometry.normals[v];
        const float square = glm::dot(normal, normal);
        if (square > 0.0F) normal /= std::sqrt(square);
        for (const std::uint32_t v : vertices) ask(found, thickness, normal, pushes[v]);
    };
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const std::array<std::uint32_t, 3> corners{triangles[t], triangles[t + 1], triangles[t + 2]};
        const auto [a, b, c] = corners;
        if (isMoved[a] + isMoved[b] + isMoved[c] == 0) continue;
        if (!near.areAll(corners)) continue;
        for (const Parents& edge : {Parents{a, b}, Parents{b, c}, Parents{c, a}}) askAmid(edge);
        askAmid(corners);
    }
    bool isAnyMoved = false;
    for (std::size_t v = 0; v < pushes.size(); ++v) {
        const double length = glm::length(pushes[v].direction);  // zero between two that press alike
        isMoved[v] = length > 0.0 ? 1 : 0;
        if (isMoved[v] == 0) continue;
        isAnyMoved = true;
        geometry.positions[v] += glm::vec3(pushes[v].most / length * pushes[v].direction);
        near.measureAgain(static_cast<std::uint32_t>(v));
    }
    return isAnyMoved;
}

}  // namespace

void keepOutside(const collision::Colliders& colliders, double thickness, std::span<const std::uint32_t> triangles,
                 view::Geometry& geometry) {
    NearSheet near(colliders, thickness, triangles, geometry.positions);
    std::vector<char> isMoved(geometry.positions.size(), 1);
    for (int pass = 0; pass < mostPasses; ++pass)
        if (!moveOut(near, thickness, triangles, isMoved, geometry)) return;
}

}  // namespace taut::world
