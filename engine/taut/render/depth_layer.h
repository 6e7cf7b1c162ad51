// How far away what a picture shows lies, as whole units. It knows no GL.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "taut/render/edge_tiles.h"
#include "taut/view/frame_view.h"

namespace taut::render {

// What was drawn of surfaces in a part of a picture of width × height, rows from below.
struct DrawnDepth {
    int width = 0, height = 0;
    PixelBox part;
    std::span<const float> depth;     // (part.width · part.height) 0 … 1; 1: nothing
    std::span<const float> nearness;  // (part.width · part.height) 1 / [m] along the camera's axis, where there is any
};

// (width · height) rows from the top: units of `unit` [m] ahead of the eye along the camera's axis, rounded;
// image::farDepth where only the sky is seen, one less for what lies farther than that. The ground is seen as far as it
// is drawn.
std::vector<std::uint16_t> depthLayer(const view::FrameView& view, const DrawnDepth& drawn, double unit);

}  // namespace taut::render
