// Solids of revolution touch as prisms; here their pairs are put where the round surface is.
//
//        N   out of the solid        The surface touches in the plane of its axis and N. An impulse there does not
//        ^                           turn it about its axis, so that it rolls over no edge of the prism.
//      __|__
//     /  |  \   prism                sag: how far the round surface is outside of the prism at most
//    |   o---|--- axis, towards us
//     \_____/
#pragma once

#include <span>
#include <vector>

#include "taut/contact/contact_constraint.h"
#include "taut/contact/elements.h"

namespace taut::contact {

// The place [m] of a round surface's ridge next to a corner of its prism where it touches what has this normal (unit,
// towards the solid), or of the corner itself where the surface is flat there or not round. x: (points) [m].
dvec3 ridgeAt(const Elements& elements, int corner, const dvec3& normal, std::span<const dvec3> x);

// Changes distances, normals, weights and places of pairs with a solid of revolution.
void roundOff(const Elements& elements, std::span<const dvec3> x, std::vector<ContactConstraint>& pairs);

}  // namespace taut::contact
