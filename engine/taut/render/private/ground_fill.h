// Plain ground and sky without GL, which takes several times as long for them: all pixels in which nothing else has
// been drawn and no shadow falls.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "taut/render/private/edge_tiles.h"
#include "taut/render/private/frame_block.h"
#include "taut/render/private/ground_kernels.h"

namespace taut::render {

// `projection` shows everything `shift` [pixels] to the right and up, in a picture of a size [pixels]. `hidden` is the
// map of ambient occlusion (occlusionEdge²), which is kept; empty: there is none.
GroundArgs groundArgs(const view::FrameView& view, const FrameBlock& block, const LightSet& lights,
                      const glm::mat4& projection, glm::ivec2 size, glm::vec2 shift, std::span<const float> hidden);

// `depths` are those of the part in which there are things, `colours` those of the picture; rows from below.
void fillGround(const GroundArgs& args, const PixelBox& part, std::span<float> depths, std::span<std::uint32_t> colours,
                int width);

}  // namespace taut::render
