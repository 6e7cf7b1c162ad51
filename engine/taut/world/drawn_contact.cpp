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

constexpr double shareKept = 0.25;  // of the thickness, between what is drawn and the collider
constexpr int drawnAtOnce = 256;    // vertices in a task

double easedStep(double from, double to, double x) {
    const double u = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}

// How a vertex goes: by the most that is asked of it, in the mean direction.
struct Push {
    double most = 0.0;    // [m]
    dvec3 direction{0.0};
};

// What a place asks for.
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
                       (1.0 - easedStep(thickness, 2.0 * thickness, depth));
    // Out of a collider's edge the way turns at once from one of its faces to the other; the normal does not.
    const double along = glm::dot(dvec3(normal), near.away), share = easedStep(0.2, 0.6, std::abs(along));
    const dvec3 out = glm::mix(near.away, std::copysign(1.0, along) * dvec3(normal), share);
    const double most = way / glm::dot(out, near.away);
    push.most = std::max(push.most, most);
    push.direction += most * out;
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

// What is near the vertices of a sheet. Only every fourth is measured if that says enough of those between.
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
            const auto [a, b] = parents_[v];
            near_[v] = isFirst(a) && isFirst(b) ? between(a, b, placeOf(v)) : measured(placeOf(v));
        });
    }
    const Near& operator[](std::size_t v) const { return near_[v]; }

    // Of a place about midway between two vertices. Its distance may be less than is said where nothing is to be done.
    Near between(std::uint32_t a, std::uint32_t b, const dvec3& place) const {
        // The planes that the distances at both ends see lie, midway, by half of how they part above the mean of both.
        const dvec3 from = placeOf(a), to = placeOf(b);
        const double rise = 0.25 * std::abs(glm::dot(near_[a].away - near_[b].away, from - to));
        const double way = glm::distance(place, 0.5 * (from + to));
        const double least = 0.5 * (near_[a].distance + near_[b].distance) - rise - way;
        return least > free_ ? Near{least, near_[a].away} : measured(place);
    }

  private:
    bool isFirst(std::uint32_t v) const { return parents_[v][1] == noParent; }
    dvec3 placeOf(std::uint32_t v) const { return dvec3(positions_[v]); }
    Near measured(const dvec3& place) const { return colliders_.nearest(place, reach_); }
    template <class Each>
    void forVertices(const Each& each) {
        core::parallelFor(static_cast<int>(near_.size()), drawnAtOnce,
                          [&](int v) { each(static_cast<std::uint32_t>(v)); });
    }

    const collision::Colliders& colliders_;
    const std::vector<glm::vec3>& positions_;
    double free_;       // [m] from a collider, where nothing moves
    double reach_ = 0;  // [m] so far that what lies between two vertices beyond is free
    std::vector<Parents> parents_;
    std::vector<Near> near_;
};

}  // namespace

void keepOutside(const collision::Colliders& colliders, double thickness, std::span<const std::uint32_t> triangles,
                 view::Geometry& geometry) {
    const NearSheet near(colliders, thickness, triangles, geometry.positions);
    std::vector<Push> pushes(geometry.positions.size());
    for (std::size_t v = 0; v < pushes.size(); ++v) ask(near[v], thickness, geometry.normals[v], pushes[v]);
    // Where the ends of an edge lie on different faces of a collider, its middle may be inside.
    forEdges(triangles, [&](std::uint32_t a, std::uint32_t b) {
        if (!std::isfinite(near[a].distance) || !std::isfinite(near[b].distance)) return;
        const dvec3 middle = 0.5 * (dvec3(geometry.positions[a]) + dvec3(geometry.positions[b]));
        const Near found = near.between(a, b, middle);
        for (const std::uint32_t end : {a, b}) ask(found, thickness, geometry.normals[end], pushes[end]);
    });
    for (std::size_t v = 0; v < pushes.size(); ++v)
        if (pushes[v].most > 0.0)
            geometry.positions[v] += glm::vec3(pushes[v].most * glm::normalize(pushes[v].direction));
}

}  // namespace taut::world
