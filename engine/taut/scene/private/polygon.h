// Cuts a polygon into triangles.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace taut::scene {

// Triangles of corner numbers, with the polygon's orientation. It cuts off the first ear in the order of the corners
// until three corners are left, which is right for concave polygons too. A polygon that crosses itself or has no area
// is cut like a fan. Expects at least three corners.
std::vector<std::array<int, 3>> polygonTriangles(std::span<const glm::dvec3> corners);

}  // namespace taut::scene
