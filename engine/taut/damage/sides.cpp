#include "taut/damage/private/sides.h"

#include <algorithm>
#include <limits>

namespace taut::world {

Sides::Sides(const Damage& damage, const BlockFrame& frame, const Remains& remains)
    : damage_(damage), frame_(frame), remains_(remains) {
    for (std::size_t cell = 0; cell < frame_.lattice().cells.size(); ++cell) {
        int number = static_cast<int>(mechanics::cellTetrahedra.size()) - 1;
        while (number >= 0 && !damage.isTetrahedronGone(cell, static_cast<std::size_t>(number))) --number;
        firstGone_.push_back(number);
    }
    findStandIns();
}

std::array<int, 4> Sides::cornersOf(const mechanics::LatticeCell& cell, int number) {
    const auto& t = mechanics::cellTetrahedra[number];
    return {cell.points[t[0]], cell.points[t[1]], cell.points[t[2]], cell.points[t[3]]};
}

void Sides::findStandIns() {
    const mechanics::Lattice& lattice = frame_.lattice();
    standIns_.assign(lattice.carriers.size(), -1);
    eachCube(lattice.counts, [&](const glm::ivec3& at) {
        if (lattice.carriers[lattice.indexOf(at)] < 0 || lattice.cellAt(at) >= 0) return;
        int nearest = 4;  // as a square
        eachCube(glm::ivec3(3), [&](const glm::ivec3& beside) {
            const glm::ivec3 way = beside - 1;
            const int cell = lattice.cellAt(at + way), square = way.x * way.x + way.y * way.y + way.z * way.z;
            if (cell < 0 || square >= nearest || isWhole(lattice.cells[cell])) return;
            nearest = square;
            standIns_[lattice.indexOf(at)] = cell;
        });
    });
}

const mechanics::LatticeCell& Sides::cellAt(const dvec3& x) const {
    const mechanics::Lattice& lattice = frame_.lattice();
    const glm::ivec3 at = glm::clamp(glm::ivec3(glm::floor(x)), glm::ivec3(0), lattice.counts - 1);
    const int standIn = standIns_[lattice.indexOf(at)];
    return standIn >= 0 ? lattice.cells[standIn] : lattice.carrierOf(x);
}

bool Sides::isWhole(const glm::ivec3& cube) const {
    const mechanics::Lattice& lattice = frame_.lattice();
    const std::size_t at = lattice.indexOf(cube);
    const int carrier = lattice.carriers[at];
    return standIns_[at] < 0 && (carrier < 0 || isWhole(lattice.cells[carrier]));
}

// It has the corners that lead from 0 to 7 along the axes by how far the place is along each. Outside of its cell it is
// the first that is gone there, so that all goes by one plane.
Sides::Tetrahedron Sides::tetrahedronAt(const dvec3& place) const {
    const dvec3 x = inCells(place);
    const mechanics::LatticeCell& cell = cellAt(x);
    const dvec3 share = glm::clamp(x - dvec3(cell.at), 0.0, 1.0);
    if (share != x - dvec3(cell.at) && !isWhole(cell)) {
        Tetrahedron gone{cornersOf(cell, firstGone(cell)), {}};
        for (std::size_t k = 0; k < 4; ++k)
            gone.weights[k] = 1.0 / (1.0 + glm::distance(remains_.rest(gone.corners[k]), place));
        return gone;
    }
    std::array<int, 3> axes{0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return share[a] > share[b]; });
    Tetrahedron own{
        {cell.points[0]},
        {1.0 - share[axes[0]], share[axes[0]] - share[axes[1]], share[axes[1]] - share[axes[2]], share[axes[2]]}};
    std::size_t corner = 0;
    for (std::size_t k = 0; k < 3; ++k)
        own.corners[k + 1] = cell.points[corner += std::size_t{1} << static_cast<unsigned>(axes[k])];
    return own;
}

int Sides::carrierAt(const dvec3& place) const {
    const Tetrahedron tetrahedron = tetrahedronAt(place);
    int carrier = -1;
    double deepest = -std::numeric_limits<double>::infinity();
    for (const Corners& group : remains_.groupsOf(tetrahedron.corners)) {
        const Plane plane = planeOf(group, tetrahedron);
        const double depth = plane.depthOf(place);
        if (plane.carrier < 0 || depth <= deepest) continue;
        deepest = depth;
        carrier = plane.carrier;
    }
    return carrier;
}

Sides::Plane Sides::planeOf(const Corners& group, const Tetrahedron& tetrahedron) const {
    Plane plane{dvec3(0.0), dvec3(0.0)};
    double most = -1.0;
    const auto isOwn = [&](int corner) { return std::find(group.begin(), group.end(), corner) != group.end(); };
    for (std::size_t k = 0; k < 4; ++k) {
        if (!isOwn(tetrahedron.corners[k])) continue;
        const int own = remains_.carrierOf(tetrahedron.corners[k]);
        const double weight = tetrahedron.weights[k] + (own == tetrahedron.corners[k] ? 1.0 : 0.0);
        if (own < 0 || weight <= most) continue;
        most = weight;
        plane.carrier = own;
    }
    if (group.size() == 4) return plane;
    std::vector<dvec3> cuts;
    dvec3 out(0.0);
    for (const int a : group)
        for (const int b : tetrahedron.corners) {
            if (isOwn(b)) continue;
            const dvec3 along = remains_.rest(b) - remains_.rest(a);
            cuts.push_back(remains_.rest(a) + damage_.share(a, b) * along);
            out += along;
        }
    for (const dvec3& cut : cuts) plane.middle += cut / static_cast<double>(cuts.size());
    const dvec3 normal = normalThrough(cuts, plane.middle, out);
    if (glm::length(normal) > 0) plane.normal = glm::normalize(normal);
    return plane;
}

bool Sides::areJoined(int a, int b) const {
    if (a == b || a < 0 || b < 0 || remains_.hold(a, b)) return true;
    const auto [known, isNew] = areJoined_.try_emplace({std::min(a, b), std::max(a, b)}, false);
    if (!isNew) return known->second;
    const Corners& beside = remains_.besideOf(b);
    known->second = std::any_of(remains_.besideOf(a).begin(), remains_.besideOf(a).end(), [&](int via) {
        return std::any_of(beside.begin(), beside.end(),
                           [&](int other) { return other == via || remains_.hold(other, via); });
    });
    return known->second;
}

}  // namespace taut::world
