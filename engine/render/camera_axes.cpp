#include "taut/render/camera_axes.h"

#include <array>
#include <glm/ext/matrix_clip_space.hpp>

namespace taut::render {

CameraAxes axesOf(const view::Camera& camera) {
    CameraAxes axes{};
    const glm::vec3 ahead = camera.target - camera.eye;
    axes.forward = glm::length(ahead) > 0.0F ? glm::normalize(ahead) : glm::vec3(0.0F, 0.0F, -1.0F);
    // Straight down or up the picture's upper edge points north.
    const std::array<glm::vec3, 3> helpers{camera.up, glm::vec3(0.0F, 0.0F, -1.0F), glm::vec3(1.0F, 0.0F, 0.0F)};
    for (const glm::vec3& helper : helpers) {
        axes.right = glm::cross(axes.forward, helper);
        if (glm::length(axes.right) > 1e-3F * glm::length(helper)) break;
    }
    axes.right = glm::normalize(axes.right);
    axes.up = glm::cross(axes.right, axes.forward);
    return axes;
}

glm::mat4 projectionOf(const view::Camera& camera, float aspect) {
    const CameraAxes axes = axesOf(camera);
    glm::mat4 view(glm::transpose(glm::mat3(axes.right, axes.up, -axes.forward)));
    view[3] = view * glm::vec4(-camera.eye, 1.0F);
    return glm::perspective(camera.fieldOfView, aspect, camera.nearPlane, camera.farPlane) * view;
}

}  // namespace taut::render
