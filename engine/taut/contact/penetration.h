// How far edges of rigid surfaces stick out of triangles that they pierce: a measure for reports. The solver does not
// use it.
#pragma once

#include <functional>
#include <span>

#include "taut/contact/crossings.h"

namespace taut::contact {

// [m] The largest height of a piece of a rigid edge over the surface it sticks out of; 0 where none does. Crossings as
// found at x (points) [m], in their order; only triangles of surfaces that are wanted count.
//
// A piece begins where the edge leaves the surface, in the direction of outOfEdge(), and ends where it enters again or
// at the end of the edge. With one triangle the height is that of the end over the triangle's plane. With two it is the
// height over both planes where they are equal: L sin α sin β / (sin α + sin β), L the length of the piece, α and β its
// angles with the planes.
double penetrationOf(const Elements& elements, std::span<const Crossing> crossings, std::span<const dvec3> x,
                     const std::function<bool(int surface)>& isWanted);

}  // namespace taut::contact
