// The mesh from which a block is made, where that is cut or torn: it goes with what is left of the cells.
//
//       . . . . . . .         A triangle that is on both sides of a cut is drawn in parts up to there, and what is cut
//       .  _____/   .         open as far as it is inside of the mesh. A place is on the side of the corner, of the
//       . /    / \  .         tetrahedron in which it is, that the cut there does not part from it.
//       ./____/   \ .
//       .\___/____/ .
//       . . / . . . .
#pragma once

#include "taut/bodies/private/placed_mesh.h"
#include "taut/bodies/private/skin_pieces.h"

namespace taut::world {

// What is drawn of it. Expects a block of a mesh, with damage that has been assessed.
Skin cutMesh(const Body& body, const PlacedMesh& mesh);

// What of it meets others: `mesh` without the triangles on both sides of a cut, and inside of it what bluntSkinOf() has
// there.
Skin bluntMesh(const Body& body, const PlacedMesh& mesh, double back);

}  // namespace taut::world
