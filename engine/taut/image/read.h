// Reads PNG and JPEG pictures. It knows nothing of textures or goldens.
#pragma once

#include <cstdint>
#include <filesystem>

#include "taut/image/image.h"

namespace taut::image {

inline constexpr std::uint64_t mostFileBytes = std::uint64_t{1} << 30U;
inline constexpr int mostEdge = 16384;                              // [px]
inline constexpr std::int64_t mostPixels = std::int64_t{1} << 26U;  // 8192 x 8192: 200 MB, and thrice that to decode

// The picture in a file, as 8-bit RGB; transparency is dropped. Throws core::Error: inputOutput when the file cannot
// be read, badContent when it is not a whole picture (truncated, damaged, another format, larger than 16384 pixels a
// side) or has more pixels than that, before memory is taken for them.
Image readImage(const std::filesystem::path& path, std::int64_t maxPixels = mostPixels);

// The same with its transparency, if it has any.
Image readImageWithAlpha(const std::filesystem::path& path, std::int64_t maxPixels = mostPixels);

struct ImageSize {
    int width = 0, height = 0;
};

// Throws core::Error(badContent) for a picture of more pixels than that.
void expectFits(const std::filesystem::path& path, ImageSize size, std::int64_t maxPixels);

}  // namespace taut::image
