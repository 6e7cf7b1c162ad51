// A direction across another one.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace taut::core {

// A unit vector at a right angle to a unit vector.
inline glm::dvec3 acrossOf(const glm::dvec3& direction) {
    return glm::normalize(
        glm::cross(direction, std::abs(direction.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

}  // namespace taut::core
