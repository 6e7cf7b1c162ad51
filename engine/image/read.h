// Reads PNG and JPEG pictures. It knows nothing of textures or goldens.
#pragma once

#include <filesystem>

#include "taut/image/image.h"

namespace taut::image {

// The picture in a file, as 8-bit RGB; transparency is dropped. Throws core::Error: inputOutput when the file cannot
// be read, badContent when it is not a whole picture (truncated, another format, larger than 16384 pixels a side).
Image readImage(const std::filesystem::path& path);

}  // namespace taut::image
