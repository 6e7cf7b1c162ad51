// Rotations from angles, with the same bits on every machine.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "taut/core/trig.h"

namespace taut::world {

// About x, then y, then z of the fixed axes [rad].
inline glm::dquat rotationOf(const glm::dvec3& angles) {
    const auto about = [](double angle, glm::dvec3 axis) {
        const glm::dvec3 v = axis * core::sine(0.5 * angle);
        return glm::dquat(core::cosine(0.5 * angle), v.x, v.y, v.z);
    };
    return about(angles.z, {0, 0, 1}) * about(angles.y, {0, 1, 0}) * about(angles.x, {1, 0, 0});
}

inline glm::dvec3 rotated(const glm::dquat& q, const glm::dvec3& x) {
    const glm::dvec3 u(q.x, q.y, q.z);
    return x + 2.0 * (q.w * glm::cross(u, x) + glm::cross(u, glm::cross(u, x)));
}

}  // namespace taut::world
