// Conditions for the inside of a mesh.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

namespace taut::mechanics {

// Throws MeshFault (builders.h) for a mesh with a hole, with faces turned against each other, or without an inside.
void expectClosed(std::span<const glm::dvec3> positions, std::span<const std::array<int, 3>> triangles);

}  // namespace taut::mechanics
