// A picture in memory and the ways to and from a PNG file. It knows neither scenes nor GL.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace taut::image {

// 8-bit sRGB, three channels, rows from top to bottom.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  // (height × width × 3)
};

}  // namespace taut::image
