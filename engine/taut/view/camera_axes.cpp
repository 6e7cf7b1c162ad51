#include "taut/view/camera_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <numbers>

namespace taut::view {

CameraAxes axesOf(const Camera& camera) {
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

Fade fadeOf(const FrameView& view) {
    const Background& background = view.background;
    // A picture from d [m] away shows things about as large; up to two thirds of d nothing should have faded.
    const float reach = 2.5F * glm::distance(view.camera.eye, view.camera.target) - 30.0F;
    const float scale = background.fadesWithCamera ? std::max(reach / background.fadeEnd, 1.0F) : 1.0F;
    return {scale * background.fadeStart, scale * background.fadeEnd};
}

float verticalField(const Camera& camera, float aspect) {
    constexpr float least = 16.0F / 9.0F;
    if (aspect >= least) return camera.fieldOfView;
    return 2.0F * std::atan(std::tan(0.5F * camera.fieldOfView) * (least / aspect));
}
float verticalField(const Camera& camera, glm::ivec2 size) {
    return verticalField(camera, static_cast<float>(size.x) / static_cast<float>(size.y));
}

float farPlaneOf(const Camera& camera) {
    return std::max(camera.farPlane, 4.0F * glm::distance(camera.eye, camera.target));
}

glm::mat4 projectionOf(const Camera& camera, float aspect) {
    const CameraAxes axes = axesOf(camera);
    glm::mat4 view(glm::transpose(glm::mat3(axes.right, axes.up, -axes.forward)));
    view[3] = view * glm::vec4(-camera.eye, 1.0F);
    const float nearPlane = std::max(camera.nearPlane, 1e-3F * glm::distance(camera.eye, camera.target));
    return glm::perspective(verticalField(camera, aspect), aspect, nearPlane, farPlaneOf(camera)) * view;
}

glm::vec2 placeOnLens(std::size_t number) {
    // Roberts' sequence in two dimensions, 2018: steps of 1 / p and 1 / p², p³ = p + 1.
    const double i = static_cast<double>(number) + 0.5;
    const double round = 0.7548776662466927 * i, out = 0.5698402909980532 * i;
    const double angle = 2.0 * std::numbers::pi * (round - std::floor(round)),
                 radius = std::sqrt(out - std::floor(out));
    return {static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle))};
}

void moveAside(Camera& camera, glm::vec2 by) {
    const CameraAxes axes = axesOf(camera);
    const glm::vec3 way = by.x * axes.right + by.y * axes.up;
    camera.eye += way;
    camera.target += way;
}

}  // namespace taut::view
