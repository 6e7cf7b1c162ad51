// The connected parts of a damaged cloth or block: springs, and intact triangles or tetrahedra.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "taut/damage/damage.h"
#include "taut/damage/private/skin_pieces.h"

namespace taut::world {

using Corners = std::vector<int>;

// Corners in groups that hold together, in their order. `hold(a, b)`: whether two do.
template <std::size_t N, class Hold>
std::vector<Corners> groupsOf(const std::array<int, N>& corners, const Hold& hold) {
    std::vector<Corners> groups;
    for (int corner : corners) {
        Corners merged;
        std::erase_if(groups, [&](const Corners& group) {
            if (std::none_of(group.begin(), group.end(), [&](int other) { return hold(corner, other); })) return false;
            merged.insert(merged.end(), group.begin(), group.end());
            return true;
        });
        merged.push_back(corner);
        groups.push_back(merged);
    }
    return groups;
}

// Visits the parts of a triangle of which the corners are in two groups, or three:
// add(v, w, x) with vertices at(corner) and beyond(a, b), where the edge from a to b is severed, on the side of a.
template <class At, class Beyond, class Add>
void splitTriangle(const std::array<int, 3>& t, const std::vector<Corners>& groups, const At& at, const Beyond& beyond,
                   const Add& add) {
    for (const Corners& group : groups) {
        // The corner of the triangle that represents the group: the only one in it, or the only one not in it.
        std::size_t k = 0;
        const auto isIn = [&](int corner) { return std::find(group.begin(), group.end(), corner) != group.end(); };
        while (isIn(t[k]) != (group.size() == 1)) ++k;
        const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
        if (group.size() == 1) {
            add(at(a), beyond(a, b), beyond(a, c));
        } else {
            add(at(b), at(c), beyond(c, a));
            add(at(b), beyond(c, a), beyond(b, a));
        }
    }
}

// A normal of the plane through places around their mean, nearly, to the side of `out`. 0 where they lie in a line.
dvec3 normalThrough(std::span<const dvec3> places, const dvec3& mean, const dvec3& out);

class Remains {
  public:
    // Expects damage that has been assessed.
    Remains(const mechanics::Model& model, const Damage& damage);

    bool hold(int a, int b) const { return held_.count({std::min(a, b), std::max(a, b)}) > 0; }
    template <std::size_t N>
    std::vector<Corners> groupsOf(const std::array<int, N>& corners) const {
        return world::groupsOf(
            corners, [this](int a, int b) { return hold(a, b); });
    }
    bool isAnyWholeAt(int point) const { return !fans_[point].empty(); }
    const Corners& besideOf(int point) const { return beside_[point]; }  // by whole springs
    // The point that carries vertices of the skin beyond a point: itself where something is intact, or of a block, in
    // a slice that is one layer of points, two springs across each other; else one of these that a spring holds to it.
    // -1: none, it is a crumb.
    int carrierOf(int point) const;
    // Finds how a vertex goes with a point: carried along by the whole triangles at its carrier, as a weighted mean
    // with more weight where they extend less, or by the tetrahedron that extends least, or by the triangle of two
    // springs. With a crumb it is the point.
    void carry(SkinVertex& vertex, int point) const;

    // Visits the corners of the tetrahedra that are gone, or of the intact ones.
    template <class Visit>
    void eachTetrahedron(bool isGone, Visit&& visit) const {
        for (std::size_t c = 0; c < model_.cells.size(); ++c)
            for (std::size_t n = 0; n < mechanics::cellTetrahedra.size(); ++n)
                if (damage_.isTetrahedronGone(c, n) == isGone) visit(tetrahedronOf(model_.cells[c], n));
    }
    const dvec3& rest(int point) const { return model_.positions[point]; }  // [m]

  private:
    template <std::size_t N>
    void addFan(const std::array<int, N>& corners);
    void addBase(int point);
    std::vector<double> inCorners(int a, const Corners& others, const dvec3& way) const;

    const mechanics::Model& model_;
    const Damage& damage_;
    std::vector<std::vector<Corners>> fans_;  // (points) whole triangles or tetrahedra, as their other corners
    std::vector<Corners> beside_;             // (points of a block)
    std::set<Damage::Edge> held_;
    std::map<int, Corners> bases_;  // (points at which nothing is intact) two others, which springs hold to them
    std::map<int, int> carriers_;   // (points at which nothing is intact)
};

}  // namespace taut::world
