// Writes a picture as a PNG file, quickly rather than small. It knows nothing of sequences.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "taut/image/image.h"

namespace taut::image {

// The bytes of a PNG file: 8-bit RGB, SUB filter, deflate level 1. Expects a whole image.
std::vector<std::byte> pngBytes(const Image& image);

// Writes the file whole or not at all; throws core::Error(inputOutput). Expects a whole image.
void writePng(const std::filesystem::path& path, const Image& image);

}  // namespace taut::image
