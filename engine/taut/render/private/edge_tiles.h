// Where smoothing can change a shaded picture: the tiles of it in which one surface ends before another. It knows
// pixels, not GL.
#pragma once

#include <cstdint>
#include <vector>

namespace taut::render {

struct PixelBox {
    int x = 0;  // from the left
    int y = 0;  // from below
    int width = 0;
    int height = 0;
};

// A part of a picture as it was shaded, rows from below.
struct ShadedPixels {
    PixelBox box;
    std::vector<std::uint32_t> colour;  // (width · height) its uppermost byte is the mark of the surface, 0 for none
    std::vector<float> depth;           // (width · height) 0 … 1
    std::vector<std::uint8_t> alpha{};  // (width · height) straight; empty: opaque
};

inline constexpr int edgeTileSize = 16;  // [pixels]

// Boxes that do not overlap and hold every pixel at an edge: its mark differs from a neighbour's, or its depth bends by
// more than half of the threshold of smoothEdges() for another surface (depth is linear along a plane).
std::vector<PixelBox> edgeTiles(const ShadedPixels& pixels);

}  // namespace taut::render
