// The mesh of a block, which goes with the corners of its cells.
#pragma once

#include <array>
#include <vector>

#include "taut/bodies/block.h"
#include "taut/body/body.h"
#include "taut/damage/private/block_frame.h"
#include "taut/drawing/drawing.h"
#include "taut/mechanics/lattice.h"

namespace taut::world {

// The cells of a block. Expects a block.
BlockFrame frameOf(const Body& body);
// Places in metres of the scene as it starts, moved with the body, as a copy of an array.
MeshPlace shiftOf(const Body& body, const BlockFrame& frame);
// The place of its mesh file.
MeshPlace meshPlaceOf(const Body& body, const BlockFrame& frame);

// The contact surface of a body in place of its model's triangles.
struct CarriedSurface {
    std::vector<dvec3> rest;                      // [m] before anything moves
    std::vector<mechanics::CarriedPoint> points;  // by points of the model
    std::vector<std::array<int, 3>> triangles;    // of these, counter-clockwise seen from outside
};

// The mesh from which a block is made, with vertices a third of a cell apart where it is finer, and no edge longer than
// one and a half; of a cut block its remaining parts, up to the cut. Empty for other bodies.
CarriedSurface carriedSurface(const Body& body);

}  // namespace taut::world
