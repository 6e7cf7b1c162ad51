// How far edges of rigid surfaces stand out of what they have gone through: a measure, of which nothing else knows.
#pragma once

#include <functional>
#include <span>

#include "taut/contact/crossings.h"

namespace taut::contact {

// [m] 0 where none does. Along an edge that goes through triangles of a surface there are pieces that are out: from one
// place where it goes out, as outOfEdge() says, to where it comes in again, or to its end. An end stands out by its
// height over the plane of the triangle; a piece with two triangles by the height over both planes where they are
// equal: L sin α sin β / (sin α + sin β), L its length, α and β its angles with them. The largest of those with a
// triangle of a surface that is wanted; crossings as found at x (points) [m], in their order.
double penetrationOf(const Elements& elements, std::span<const Crossing> crossings, std::span<const dvec3> x,
                     const std::function<bool(int surface)>& isWanted);

}  // namespace taut::contact
