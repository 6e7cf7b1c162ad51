// Two solids that lie on each other touch at many places of one plane, corners and crossing edges. For solids those at
// the corners of their convex hull say it all: what keeps these apart keeps the others.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "taut/contact/contact_constraint.h"
#include "taut/contact/elements.h"

namespace taut::contact {

// Drops pairs of two solids inside the hull of others of these that are on the same plane and as near, to a thousandth
// of the thickness. x: (points) [m].
void keepCorners(const Elements& elements, std::span<const dvec3> x, std::vector<ContactConstraint>& pairs);

}  // namespace taut::contact
