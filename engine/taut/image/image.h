// A picture in memory. It knows neither files nor scenes nor GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace taut::image {

inline constexpr std::uint16_t farDepth = 65535;  // where there is nothing

// Of a picture, beside its colours: one or three numbers of 16 bits a pixel, or three of 8. The other array is empty.
struct Layer {
    std::string name;                      // "depth"
    std::string comment{};                 // meaning of the numbers of 16 bits, for the files
    std::vector<std::uint16_t> numbers{};  // (height × width) or (height × width × 3)
    std::vector<std::uint8_t> rgb{};       // (height × width × 3)
};

// 8-bit sRGB, three channels, rows from top to bottom. Layers beside the colours are empty unless requested.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;      // (height × width × 3)
    std::vector<std::uint8_t> alpha{};  // (height × width) straight, not premultiplied; empty: opaque
    std::vector<Layer> layers{};

    // nullptr when there is none of that name.
    const Layer* layer(std::string_view wanted) const {
        for (const Layer& each : layers)
            if (each.name == wanted) return &each;
        return nullptr;
    }

    // Whether the array of colours has the length that width and height ask for, and there is at least one pixel.
    bool isWhole() const {
        return width > 0 && height > 0 &&
               rgb.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
    }
};

}  // namespace taut::image
