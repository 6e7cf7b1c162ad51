// Shadows on a ground that is not there, as colour and alpha. It knows no GL.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "taut/view/frame_view.h"

namespace taut::render {

// Where a pixel has no mark in its uppermost byte, its bytes are the share of the ground's colour under shadows. They
// are replaced by a straight colour and alpha with which a ground of that colour looks as it would under the shadow,
// blended byte by byte, as programs do; for other grounds the darkest channel is exact. Returns alpha (pixels), 255 on
// surfaces.
std::vector<std::uint8_t> takeShadows(const view::FrameView& view, std::span<std::uint32_t> colours);

}  // namespace taut::render
