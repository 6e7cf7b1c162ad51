#include "taut/core/mass_properties.h"

#include <glm/gtc/constants.hpp>

namespace taut::core {

// Tetrahedra from one corner: ∫ x xᵀ of one is det / 120 (a aᵀ + b bᵀ + c cᵀ + s sᵀ), s = a + b + c.
MassProperties massPropertiesOf(std::span<const glm::dvec3> positions, std::span<const std::array<int, 3>> triangles) {
    MassProperties all;
    if (positions.empty()) return all;
    const glm::dvec3 origin = positions[0];
    glm::dmat3 spread(0.0);
    glm::dvec3 moment(0.0);
    for (const std::array<int, 3>& t : triangles) {
        const glm::dvec3 a = positions[t[0]] - origin;
        const glm::dvec3 b = positions[t[1]] - origin;
        const glm::dvec3 c = positions[t[2]] - origin;
        const glm::dvec3 s = a + b + c;
        const double det = glm::dot(a, glm::cross(b, c));
        all.volume += det / 6;
        moment += (det / 24) * s;
        spread += (det / 120) * (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) +
                                 glm::outerProduct(s, s));
    }
    if (!(all.volume > 0)) return all;
    const glm::dvec3 centre = moment / all.volume;
    all.centre = origin + centre;
    all.spread = spread - all.volume * glm::outerProduct(centre, centre);
    return all;
}

MassProperties massPropertiesOfBall(double radius) {
    return massPropertiesOfCapsule(radius, 0.0);
}

// A cylinder and two half balls, each of which has 3/8 r between its middle and its centre of mass.
MassProperties massPropertiesOfCapsule(double radius, double height) {
    const double square = radius * radius, cylinder = glm::pi<double>() * square * height;
    const double ball = 4.0 / 3.0 * glm::pi<double>() * square * radius, h = 0.5 * height;
    const double across = cylinder * square / 4 + ball * square / 5;
    const double along = cylinder * h * h / 3 + ball * (square / 5 + h * h + 0.75 * h * radius);
    return {cylinder + ball, glm::dvec3(0.0), glm::dmat3(across, 0, 0, 0, along, 0, 0, 0, across)};
}

MassProperties massPropertiesOfCylinder(double radius, double height) {
    const double volume = glm::pi<double>() * radius * radius * height;
    const double across = volume * radius * radius / 4, along = volume * height * height / 12;
    return {volume, glm::dvec3(0.0), glm::dmat3(across, 0, 0, 0, along, 0, 0, 0, across)};
}

MassProperties massPropertiesOfCone(double radius, double height) {
    const double volume = glm::pi<double>() * radius * radius * height / 3;
    const double across = 3 * volume * radius * radius / 20, along = 3 * volume * height * height / 80;
    return {volume, {0.0, -0.25 * height, 0.0}, glm::dmat3(across, 0, 0, 0, along, 0, 0, 0, across)};
}

}  // namespace taut::core
