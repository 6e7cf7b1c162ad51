// The mesh of a block, which goes with the corners of its cells.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "taut/bodies/block.h"
#include "taut/bodies/body.h"
#include "taut/mechanics/lattice.h"

namespace taut::world {

// Where the cells of a block are before anything moves, and what they carry.
class BlockFrame {
  public:
    // Expects a block.
    explicit BlockFrame(const Body& body);

    const BlockSpec& block() const { return *block_; }
    const mechanics::Lattice& lattice() const { return *lattice_; }
    // [m] How far a place of the block's mesh in metres and turned has been moved with the body, as a copy of an array.
    dvec3 shift() const;
    // [m] Where places of the block's mesh file are.
    std::vector<dvec3> placesOf(std::span<const dvec3> file) const;
    // A place [m] along the axes of the block, from the low corner of the box around its cells [m].
    dvec3 inside(const dvec3& place) const;
    dvec3 place(const dvec3& inside) const;  // the reverse

  private:
    const BlockSpec* block_;
    std::shared_ptr<const mechanics::Lattice> lattice_;
    dvec3 first_;  // [m] the first point
    glm::dquat turn_;
};

// What of a whole body meets others in place of its model's triangles.
struct CarriedSurface {
    std::vector<dvec3> rest;                      // [m] before anything moves
    std::vector<mechanics::CarriedPoint> points;  // by points of the model
    std::vector<std::array<int, 3>> triangles;    // of these, counter-clockwise seen from outside
};

// The mesh from which a block is made, with vertices a third of a cell apart where it is finer, and no edge longer than
// one and a half; of a block that is cut what is left of it, up to the cut. Empty for other bodies.
CarriedSurface carriedSurface(const Body& body);

}  // namespace taut::world
