// The floor as a disc of cells, sorted by whether a shadow can fall on them. Pure geometry, it knows no GL.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "taut/render/private/lights.h"
#include "taut/render/private/occlusion_pass.h"

namespace taut::render {

struct GroundMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> shaded;    // triangles that a shadow may reach
    std::vector<std::uint32_t> darkened;  // others from which something may hide a part of the sky
    std::vector<std::uint32_t> open;      // triangles in full light
    std::vector<std::uint8_t> changes;    // (positions) 1: moving things may change the cell whose triangles begin
                                          // there
};

// The disc of `radius` [m] around the camera's target, fine in the middle, coarse outside. `casters` are boxes around
// all casters of shadows in any of the lights, the smaller the better, `moving` the boxes of casters that have moved
// since the last picture.
GroundMesh groundMesh(glm::vec3 middle, float height, float radius, std::span<const Shadower> lights,
                      std::span<const Bounds> casters, const std::optional<OcclusionArea>& occlusion,
                      std::span<const Bounds> moving = {});

// Leaves of the shaded cells those of their pieces that are not lit, of which the corners are given.
void leaveShaded(GroundMesh& mesh, const std::function<bool(std::span<const glm::vec3, 4> corners)>& isLit);

}  // namespace taut::render
