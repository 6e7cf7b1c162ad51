// Cameras and lights as matrices, and the moving part of a matrix. Independent of formats.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace taut::geometry {

// Looks along its own -z; `up` need not be at right angles to it, but for where both are the same.
inline glm::mat4 looking(glm::vec3 from, glm::vec3 along, glm::vec3 up) {
    const glm::vec3 z = -glm::normalize(along);
    glm::vec3 x = glm::cross(up, z);
    if (glm::dot(x, x) < 1e-8F) x = glm::cross(glm::vec3(0.0F, 0.0F, 1.0F), z);
    if (glm::dot(x, x) < 1e-8F) x = glm::vec3(1.0F, 0.0F, 0.0F);
    x = glm::normalize(x);
    return {glm::vec4(x, 0.0F), glm::vec4(glm::cross(z, x), 0.0F), glm::vec4(z, 0.0F), glm::vec4(from, 1.0F)};
}

// Of a matrix that turns and shifts; the one of the two quaternions that lies nearer to `before`.
inline glm::quat rotationIn(const glm::mat4& matrix, const glm::quat& before) {
    const glm::quat q = glm::normalize(glm::quat_cast(glm::mat3(matrix)));
    return glm::dot(q, before) < 0.0F ? -q : q;
}

}  // namespace taut::geometry
