// A picture in memory. It knows neither files nor scenes nor GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace taut::image {

inline constexpr std::uint16_t farDepth = 65535;  // where there is nothing

// 8-bit sRGB, three channels, rows from top to bottom. What lies beside the colours is empty where nobody asked for it.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;       // (height × width × 3)
    std::vector<std::uint8_t> alpha{};   // (height × width) straight: colours are not multiplied by it; empty: opaque
    std::vector<std::uint16_t> depth{};  // (height × width) in units that the renderer was given; farDepth: nothing
    std::vector<std::uint8_t> mask{};    // (height × width × 3) a flat colour for each thing

    // Whether the array of colours has the length that width and height ask for, and there is at least one pixel.
    bool isWhole() const {
        return width > 0 && height > 0 &&
               rgb.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
    }
};

}  // namespace taut::image
