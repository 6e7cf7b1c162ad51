// Writes a picture as a PNG file, quickly rather than small. It knows nothing of sequences.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "taut/image/image.h"

namespace taut::image {

// The bytes of a PNG file: 8-bit RGB, or RGBA where the image has alpha, SUB filter, deflate level 1. Expects a whole
// image.
std::vector<std::byte> pngBytes(const Image& image);

// The bytes of a PNG file of one or three channels of 16 bits, with a comment under the keyword "Description"
// (Latin-1). Expects (height × width) or (height × width × 3) numbers.
std::vector<std::byte> widePngBytes(int width, int height, std::span<const std::uint16_t> numbers,
                                    std::string_view comment);

// Writes the file whole or not at all; throws core::Error(inputOutput). Expects a whole image.
void writePng(const std::filesystem::path& path, const Image& image);

}  // namespace taut::image
