// On which side of the cuts through a block a place of it is: which corner of a cell it goes with.
//
//      c - + - d      A cut parts the corners a, c from b, d of a tetrahedron. The plane through where it severs their
//      |   \   |      edges parts places, too. In a cube where the mesh has so little that there is no cell, the plane
//      a - -+- b      of a damaged cell beside it goes on.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "taut/damage/private/block_frame.h"
#include "taut/damage/private/remains.h"

namespace taut::world {

class Sides {
  public:
    // Expects a block of a mesh with damage that has been assessed. Expects that it and its remains do not change.
    Sides(const Damage& damage, const BlockFrame& frame, const Remains& remains);

    dvec3 inCells(const dvec3& place) const { return frame_.inside(place) / frame_.lattice().cell; }

    // The cell by which places, in cells, are on a side; where it is not damaged, the cell that carries them.
    const mechanics::LatticeCell& cellAt(const dvec3& x) const;
    bool isWhole(const mechanics::LatticeCell& cell) const { return firstGone(cell) < 0; }
    bool isWhole(const glm::ivec3& cube) const;  // also where it has no cell

    // The corner that carries a place: of its tetrahedron the nearest one on its side of the cut, or one that a spring
    // holds to that. Crumbs (remains.h) go with the other side. -1: there is nothing but crumbs.
    int carrierAt(const dvec3& place) const;
    // Whether two corners that are near each other hold together, by three springs at most, or one is none.
    bool areJoined(int a, int b) const;

    // Of a cut through a tetrahedron, for the side of a group of its corners.
    struct Plane {
        dvec3 middle, normal;  // [m]; the unit normal points away from the group; 0 where the cut is no plane
        int carrier = -1;      // of that side; -1: crumbs
        double depthOf(const dvec3& place) const { return glm::dot(middle - place, normal); }  // [m]
    };
    // Visits cubes that have no cell, and each side of the plane that goes on there.
    template <class Visit>
    void eachPlaneBeside(const Visit& visit) const {
        const mechanics::Lattice& lattice = frame_.lattice();
        eachCube(lattice.counts, [&](const glm::ivec3& cube) {
            const int standIn = standIns_[lattice.indexOf(cube)];
            if (standIn < 0) return;
            const mechanics::LatticeCell& cell = lattice.cells[standIn];
            const std::array<int, 4> corners = cornersOf(cell, firstGone(cell));
            for (const Corners& group : remains_.groupsOf(corners)) visit(cube, planeOf(group, {corners, {}}));
        });
    }

    template <class Visit>
    static void eachCube(const glm::ivec3& counts, const Visit& visit) {
        for (int z = 0; z < counts.z; ++z)
            for (int y = 0; y < counts.y; ++y)
                for (int x = 0; x < counts.x; ++x) visit(glm::ivec3(x, y, z));
    }

  private:
    struct Tetrahedron {
        std::array<int, 4> corners;
        std::array<double, 4> weights;  // of the corners at a place
    };

    static std::array<int, 4> cornersOf(const mechanics::LatticeCell& cell, int number);
    int firstGone(const mechanics::LatticeCell& cell) const {
        return firstGone_[&cell - frame_.lattice().cells.data()];
    }
    void findStandIns();
    Tetrahedron tetrahedronAt(const dvec3& place) const;
    Plane planeOf(const Corners& group, const Tetrahedron& tetrahedron) const;

    const Damage& damage_;
    const BlockFrame& frame_;
    const Remains& remains_;
    std::vector<int> firstGone_;  // (cells) the number of a tetrahedron whose corners do not hold together; -1: none
    std::vector<int> standIns_;   // (cubes) the damaged cell beside those without one; -1: none
    mutable std::map<std::pair<int, int>, bool> areJoined_;
};

}  // namespace taut::world
