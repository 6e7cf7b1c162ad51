// Places on rigid bodies by name, and as spots that move with them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "taut/body/body.h"
#include "taut/body/spot.h"

namespace taut::world {

// [m] In the scene as it starts: "centre" of the mass; "top-middle" of the box around the body in its own axes, or
// "top" if no points have that name; of a box also the middles of edges, "front-top-middle". None if the body is not
// rigid or has no such place.
std::optional<dvec3> placeNamed(const Body& body, std::string_view selector);
// The names that a rigid body of this model has; none of another body.
std::vector<std::string> placeNames(const mechanics::Model& model);
// The spot of a rigid body, in numbers of its model, that is at a place [m] of the scene as it starts.
Spot spotAt(const Body& body, const dvec3& place);
// [m] The diagonal of the box around a body's points.
double sizeOf(const Body& body);

}  // namespace taut::world
