// A picture in memory. It knows neither files nor scenes nor GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace taut::image {

// 8-bit sRGB, three channels, rows from top to bottom.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  // (height × width × 3)

    // Whether the array has the length that width and height ask for, and there is at least one pixel.
    bool isWhole() const {
        return width > 0 && height > 0 &&
               rgb.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
    }
};

}  // namespace taut::image
