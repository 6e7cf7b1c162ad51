// Which part of the world the shadow map covers: pure geometry, it knows no GL.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "taut/view/frame_view.h"

namespace taut::render {

struct Bounds {
    glm::vec3 low{0.0F};  // [m]
    glm::vec3 high{0.0F};
    bool empty = true;

    void include(glm::vec3 point);
    Bounds transformed(const glm::mat4& transform) const;
    std::array<glm::vec3, 8> corners() const;
};

// A box along the light. Map coordinates: x and y from 0 to 1 across it, z from 0 (next to the light) to 1.
struct LightBox {
    glm::mat4 toMap{1.0F};    // world to map coordinates
    glm::mat3 toLight{1.0F};  // world directions to (right, up, towards the light), lengths kept
    glm::vec3 size{1.0F};     // [m] extent along right, up and towards the light
};

// Unit.
inline glm::vec3 towardsLight(const LightBox& box) {
    return glm::transpose(box.toLight)[2];
}

// Fits the box of a light that travels in a direction to the casters as far as the camera needs them, in steps so that
// the map does not crawl from frame to frame, with a margin [m] to each side. `texels` is the edge of the map.
LightBox lightBox(const view::FrameView& view, glm::vec3 direction, std::span<const Bounds> casters, float aspect,
                  int texels, float margin = 0.0F);

}  // namespace taut::render
