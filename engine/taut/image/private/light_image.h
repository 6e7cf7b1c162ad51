// Pictures of light: the surroundings of a scene, in their brightness.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "taut/image/read.h"

namespace taut::image {

// Linear light, 1 is white paper in full light, rows from the top.
struct LightImage {
    int width = 0, height = 0;
    std::vector<float> rgb;  // (3 · width · height), 0 … brightest
};

inline constexpr float brightest = 65504.0F;                             // the largest half float
inline constexpr std::int64_t mostLightPixels = std::int64_t{1} << 25U;  // 8192 x 4096: 400 MB

// The picture in a file: Radiance HDR (G. Ward, "Real Pixels", Graphics Gems II, 1991; lines from the top, left to
// right, "-Y height +X width"), or PNG or JPEG, whose bytes are sRGB. Values above `brightest` are clamped. Throws
// core::Error: inputOutput if the file cannot be read, badContent if the picture is incomplete or has too many pixels,
// before memory is allocated.
LightImage readLightImage(const std::filesystem::path& path, std::int64_t maxPixels = mostLightPixels);

// Of such a file, looked through to its end. Throws the same.
ImageSize lightImageSize(const std::filesystem::path& path, std::int64_t maxPixels = mostLightPixels);

// Throws core::Error(badContent) for a picture that is not twice as wide as high, as one of all that is around is.
void expectAllAround(const std::filesystem::path& path, ImageSize size);

}  // namespace taut::image
