// A picture in another size. It knows no files.
#pragma once

#include "taut/image/image.h"

namespace taut::image {

// Averages light, not the bytes of the sRGB curve. Expects a whole image and a size of at least one pixel.
Image resized(const Image& image, int width, int height);

// Quicker: mixes the bytes of the four pixels around each place, for a screen. Expects a size that is no smaller.
Image enlarged(const Image& image, int width, int height);

}  // namespace taut::image
