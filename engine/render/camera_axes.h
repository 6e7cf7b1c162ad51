// The directions of a camera, also of one that looks along its own up direction. Pure geometry.
#pragma once

#include <glm/glm.hpp>

#include "taut/view/frame_view.h"

namespace taut::render {

struct CameraAxes {
    glm::vec3 right, up, forward;  // unit, at right angles
};

// Where eye and target are the same it looks along -z.
CameraAxes axesOf(const view::Camera& camera);

// Where the ground begins to fade and has gone [m], from the camera's target.
struct Fade {
    float start, end;
};
Fade fadeOf(const view::FrameView& view);

// World to clip coordinates of GL, with planes that suit how far the camera looks. `aspect` is width / height of the
// picture, above zero.
float farPlaneOf(const view::Camera& camera);  // [m]
glm::mat4 projectionOf(const view::Camera& camera, float aspect);

}  // namespace taut::render
