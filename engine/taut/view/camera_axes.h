// The axes of a camera, also if it looks along its own up direction. Pure geometry.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "taut/view/frame_view.h"

namespace taut::view {

struct CameraAxes {
    glm::vec3 right, up, forward;  // unit, at right angles
};

// If eye and target are the same, it looks along -z.
CameraAxes axesOf(const Camera& camera);

// The distances from the camera's target at which the ground begins to fade and at which it has gone [m].
struct Fade {
    float start, end;
};
Fade fadeOf(const FrameView& view);

// The vertical angle of a picture [rad]; `aspect` is width / height, above zero. It is the camera's in pictures of 16:9
// and wider. A narrower picture shows the width that 16:9 does, and so more above and below.
float verticalField(const Camera& camera, float aspect);
float verticalField(const Camera& camera, glm::ivec2 size);  // of the picture

// The matrix from world to GL clip coordinates, with near and far planes that suit the camera's distance.
float farPlaneOf(const Camera& camera);  // [m]
glm::mat4 projectionOf(const Camera& camera, float aspect);

// A place in a disc of radius 1. Consecutive numbers give places that are spread evenly.
inline constexpr std::size_t placesOnLens = 32;
glm::vec2 placeOnLens(std::size_t number);
// To the right and up [m], looking the same way.
void moveAside(Camera& camera, glm::vec2 by);

}  // namespace taut::view
