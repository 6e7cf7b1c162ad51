// The common inputs of all shaders, laid out as the uniform block Frame of shaders/frame.glsl (std140).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "taut/render/private/lights.h"
#include "taut/render/private/occlusion_pass.h"
#include "taut/view/frame_view.h"

namespace taut::render {

struct LampBlock {
    glm::mat4 toMap;
    glm::mat4 toLight;
    glm::vec4 way;
    glm::vec4 colour;
    glm::vec4 mapSize;
};

struct FrameBlock {
    glm::mat4 viewProjection;
    glm::mat4 toMap;
    glm::mat4 toLight;
    glm::vec4 eye;
    glm::vec4 lightWay;
    glm::vec4 lightColour;
    glm::vec4 skyLight;
    glm::vec4 groundLight;
    glm::vec4 backgroundTop;
    glm::vec4 backgroundHorizon;
    glm::vec4 fade;
    glm::vec4 mapSize;
    glm::vec4 occlusionArea;
    glm::vec4 groundColour;
    glm::vec4 debug;
    glm::vec4 around;
    std::array<glm::vec4, 9> ambient;
    std::array<LampBlock, view::mostLamps> lamps;
};
static_assert(sizeof(LampBlock) == 2 * 64 + 3 * 16);
static_assert(sizeof(FrameBlock) == 3 * 64 + 22 * 16 + view::mostLamps * sizeof(LampBlock));

// Of a view, its lights with shadow maps of so many texels a side, and where things darken the ground;
// EnvironmentMap adds the picture around.
FrameBlock blockOf(const view::FrameView& view, const glm::mat4& projection, const LightSet& lights, int texels,
                   const std::optional<OcclusionArea>& occlusion);

}  // namespace taut::render
