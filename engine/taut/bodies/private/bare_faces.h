// The faces inside a block that cuts and tears have bared.
#pragma once

#include <array>
#include <vector>

#include "taut/bodies/body.h"

namespace taut::world {

// (triangles) points of the model, counter-clockwise seen from outside. These are the faces of whole tetrahedra that
// neither another whole one shares nor the rest of the surface covers; none while all are whole. They change only when
// goneAround() of the damage does. In the order of the model's cells. Expects damage that has been assessed.
std::vector<std::array<int, 3>> bareFaces(const Body& body);

}  // namespace taut::world
