// The area that triangles cover of a plane, each place counted once. It knows no body.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <vector>

namespace taut::check {

using FlatTriangle = std::array<glm::dvec2, 3>;

// The area of their union [m²]. Along x the cover is exact, along y it is summed at the middle of some 4000 strips
// between corners (midpoint rule): exact to rounding where no edges cross and corners are fewer, else of second order.
double coveredArea(std::vector<FlatTriangle> triangles);

}  // namespace taut::check
