// The mesh from which a block is made, where that is cut or torn: it moves with the remaining cells.
//
//       . . . . . . .         A triangle on both sides of a cut is drawn in parts up to the cut. Faces of cuts are
//       drawn .  _____/   .         as far as they are inside of the mesh. A place is on the side of the corner, of the
//       . /    / \  .         tetrahedron in which it is, that the cut there does not part from it.
//       ./____/   \ .
//       .\___/____/ .
//       . . / . . . .
#pragma once

#include "taut/damage/private/block_frame.h"
#include "taut/damage/private/placed_mesh.h"
#include "taut/damage/private/skin_pieces.h"

namespace taut::world {

// The drawn skin. Expects a block of a mesh, with damage that has been assessed.
Skin cutMesh(const mechanics::Model& model, const Damage& damage, const BlockFrame& frame, const PlacedMesh& mesh);

// Its contact surface: `mesh` without the triangles on both sides of a cut, and the part of bluntSkinOf() inside of it.
Skin bluntMesh(const mechanics::Model& model, const Damage& damage, const BlockFrame& frame, const PlacedMesh& mesh,
               double back);

}  // namespace taut::world
