// How the mass of a rigid body lies, for a density of 1. It knows no shapes.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

namespace taut::core {

struct MassProperties {
    double volume = 0;       // [m³]
    glm::dvec3 centre{0.0};  // [m] of mass
    glm::dmat3 spread{0.0};  // [m⁵] ∫ r rᵀ dV about the centre
};
// Exact for a closed polyhedron with outward triangles; volume <= 0 if they face inward.
MassProperties massPropertiesOf(std::span<const glm::dvec3> positions, std::span<const std::array<int, 3>> triangles);
MassProperties massPropertiesOfBall(double radius);
// Axis y; `height` between the centres of its half balls.
MassProperties massPropertiesOfCapsule(double radius, double height);
// About y, between -height/2 and height/2, of a cylinder or a cone with its tip up.
MassProperties massPropertiesOfCylinder(double radius, double height);
MassProperties massPropertiesOfCone(double radius, double height);

}  // namespace taut::core
