// The cells of a block: all cells of a box, or the cells that a closed mesh fills, each with its share. Independent of
// materials.
//
//        . . . . . . .          A mesh in a lattice of cubes. The filled part of a cell counts at its corners c by
//        .   ______  .            shares[c] = ∫ N_c dV / V,   N_c trilinear, over the inside of the mesh:
//        . /|   |  \ .          their sum is the share of the cell that is filled, and masses by these shares have the
//        ./_|___|___\.          mesh's mass and centre. A spring along an edge lies in the cell as N of its two ends
//        .\_|___|___/.          does, one in a face as N of the face's corners. Full cells have eighths.
//        . . . . . . .
//
// Cubes are cut by the surface and not drawn to it: springs along edges and diagonals cannot give a cell that is
// squeezed by more than a fifth the moduli of its material (block_builder.cpp).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace taut::mechanics {

// The number of a place in a box of so many, x fastest, then y, then z.
inline std::size_t indexIn(glm::ivec3 counts, glm::ivec3 place) {
    return static_cast<std::size_t>(place.x) +
           static_cast<std::size_t>(counts.x) *
               (static_cast<std::size_t>(place.y) +
                static_cast<std::size_t>(counts.y) * static_cast<std::size_t>(place.z));
}

// Corners as those of VolumeCell: corner c is at the far end of axis 0, 1, 2 if bit 0, 1, 2 of c is set.
struct LatticeCell {
    glm::ivec3 at{0};
    std::array<double, 8> shares{};
    std::array<int, 8> points{};
    double share() const;  // of the cell, as if full: 1; a little more with the part of a merged neighbour
};

// A place that moves with the corners of a cell, by trilinear weights. Forces there are shared by the corners with the
// same weights: the sum of forces and their torque stay.
struct CarriedPoint {
    std::array<int, 8> points{};
    std::array<double, 8> weights{};  // their sum is 1; beyond 0 … 1 outside of the cell
};

struct Lattice {
    glm::ivec3 counts{0};            // cells of the box
    glm::dvec3 cell{0.0};            // [m] sides of one
    glm::dvec3 centre{0.0};          // [m] of the box, in the mesh's coordinates
    std::vector<LatticeCell> cells;  // x fastest, then y, then z
    std::vector<glm::ivec3> points;  // places of their corners, in the same units
    std::vector<int> carriers;       // (cells of the box) the cell that carries the content of each; -1: none
    bool isFilledTwice = false;      // parts of the mesh fill the same place

    std::size_t indexOf(glm::ivec3 place) const { return indexIn(counts, place); }
    // The cell at a place; -1: none.
    int cellAt(glm::ivec3 place) const;
    // The cell that carries x, counted in cells from the low corner of the box: the one around it, or the nearest.
    const LatticeCell& carrierOf(const glm::dvec3& x) const;
};

// A place carried by that cell, counted in cells too.
CarriedPoint carriedBy(const LatticeCell& cell, const glm::dvec3& x);

// All cells of a box.
Lattice fullLattice(glm::ivec3 counts, const glm::dvec3& size);

// The box of a mesh in cubes, before any are left out; doubles, as they may be far beyond any integer.
glm::dvec3 boxCells(std::span<const glm::dvec3> positions, double side);

// The cubes that a mesh fills, with edges changed by at most a twentieth to fit its box, from exact integrals over its
// inside: each place counts as often as the mesh winds around it, at most once. A cell less than a quarter full is left
// out unless that would disconnect a part; a neighbour carries its content. Only + - * / and square roots: the same
// bits everywhere. Expects as many cells as an array can have. Throws MeshFault (builders.h) for a mesh that is not
// closed, has faces turned against each other, is inside out or crosses itself so that a part of it is.
Lattice meshLattice(std::span<const glm::dvec3> positions, std::span<const std::array<int, 3>> triangles, double side);

}  // namespace taut::mechanics
