// The faces inside a block that cuts and tears have laid open.
#pragma once

#include <array>
#include <vector>

#include "taut/bodies/body.h"

namespace taut::world {

// (triangles) points of the model, counter-clockwise seen from outside: faces of whole tetrahedra that neither another
// whole one nor what is left of the surface has; none while all are whole. They are others only after goneAround() of
// the damage is. In the order of the model's cells. Expects damage that has been assessed.
std::vector<std::array<int, 3>> bareFaces(const Body& body);

}  // namespace taut::world
