// Edges that go through triangles, counted without anything of the engine's contact: boxes swept along one axis, and
// signs of volumes. A witness for tests of crossings.
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "support/scenes.h"

namespace taut::test {

struct Skin {
    std::vector<std::array<int, 3>> triangles;  // of points
    std::vector<std::array<int, 2>> edges;

    // With all of its edges.
    void addTriangle(int a, int b, int c) {
        triangles.push_back({a, b, c});
        for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) addEdge(p, q);
    }
    void addEdge(int a, int b) {
        const std::array<int, 2> edge{std::min(a, b), std::max(a, b)};
        if (known_.insert(edge).second) edges.push_back(edge);
    }

  private:
    std::set<std::array<int, 2>> known_;
};

// Six times the volume of a tetrahedron, positive where d sees a, b, c turn clockwise.
inline double sixVolumes(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

// The ends lie on two sides of the triangle, and all of its edges go round the segment in one direction.
inline bool goesThrough(const dvec3& p, const dvec3& q, const std::array<dvec3, 3>& t) {
    const double above = sixVolumes(t[0], t[1], t[2], p), below = sixVolumes(t[0], t[1], t[2], q);
    if (!(above * below < 0)) return false;
    const double first = sixVolumes(p, q, t[0], t[1]), second = sixVolumes(p, q, t[1], t[2]),
                 third = sixVolumes(p, q, t[2], t[0]);
    return (first > 0 && second > 0 && third > 0) || (first < 0 && second < 0 && third < 0);
}

// Pairs of an edge and a triangle without a common point that the edge goes through, at places x (points) [m].
inline int countPiercings(const Skin& skin, const std::vector<dvec3>& x) {
    const auto at = [&](int i) { return x[i]; };
    struct Span {
        dvec3 low, high;
        int item;
        bool isTriangle;
    };
    std::vector<Span> spans;
    for (std::size_t e = 0; e < skin.edges.size(); ++e) {
        const dvec3 p = at(skin.edges[e][0]), q = at(skin.edges[e][1]);
        spans.push_back({glm::min(p, q), glm::max(p, q), static_cast<int>(e), false});
    }
    for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
        const auto& c = skin.triangles[t];
        spans.push_back({glm::min(at(c[0]), glm::min(at(c[1]), at(c[2]))),
                         glm::max(at(c[0]), glm::max(at(c[1]), at(c[2]))), static_cast<int>(t), true});
    }
    std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.low.x < b.low.x; });
    int count = 0;
    for (std::size_t i = 0; i < spans.size(); ++i)
        for (std::size_t j = i + 1; j < spans.size() && spans[j].low.x <= spans[i].high.x; ++j) {
            const Span &a = spans[i], &b = spans[j];
            if (a.isTriangle == b.isTriangle || a.low.y > b.high.y || b.low.y > a.high.y || a.low.z > b.high.z ||
                b.low.z > a.high.z)
                continue;
            const auto& edge = skin.edges[a.isTriangle ? b.item : a.item];
            const auto& t = skin.triangles[a.isTriangle ? a.item : b.item];
            if (std::any_of(t.begin(), t.end(), [&](int k) { return k == edge[0] || k == edge[1]; })) continue;
            if (goesThrough(at(edge[0]), at(edge[1]), {at(t[0]), at(t[1]), at(t[2])})) ++count;
        }
    return count;
}

// Of the bodies of a scene together; expects that none is an array, and that all are in the world when it is asked.
class PiercingWitness {
  public:
    PiercingWitness(const world::SceneSpec& scene, std::vector<std::string> bodies) : bodies_(std::move(bodies)) {
        int first = 0;
        for (const std::string& name : bodies_)
            for (const world::BodySpec& spec : scene.bodies) {
                if (spec.fullName() != name) continue;
                const mechanics::Model model = spec.build(scene);
                for (const auto& t : model.triangles) skin_.addTriangle(first + t[0], first + t[1], first + t[2]);
                if (model.triangles.empty())
                    for (const mechanics::Spring& s : model.springs)
                        if (s.kind == mechanics::SpringKind::structural) skin_.addEdge(first + s.a, first + s.b);
                first += model.pointCount();
            }
    }

    int count(world::World& world) const { return countPiercings(skin_, positions(world)); }
    // Of all of the bodies, one after the other.
    std::vector<dvec3> positions(world::World& world) const {
        std::vector<dvec3> all;
        for (const std::string& name : bodies_) {
            const std::vector<dvec3> own = positionsOf(world, name);
            all.insert(all.end(), own.begin(), own.end());
        }
        return all;
    }

  private:
    std::vector<std::string> bodies_;
    Skin skin_;
};

}  // namespace taut::test
