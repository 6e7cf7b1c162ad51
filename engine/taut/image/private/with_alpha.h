// Interleaved colours and alpha, as in files and encoders, and layers over both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "taut/core/error.h"
#include "taut/image/image.h"

namespace taut::image {

// (height × width × 4). Expects a whole image that has alpha.
inline std::vector<std::uint8_t> withAlpha(const Image& image) {
    TAUT_EXPECTS(image.isWhole() && 3 * image.alpha.size() == image.rgb.size());
    std::vector<std::uint8_t> four(4 * image.alpha.size());
    for (std::size_t i = 0; i < image.alpha.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) four[4 * i + c] = image.rgb[3 * i + c];
        four[4 * i + 3] = image.alpha[i];
    }
    return four;
}

// Covers a part, 0 … 1, of a pixel. Returns the share of the pixel's visible colour that is new.
inline float coverPart(Image& image, std::size_t pixel, float part) {
    if (image.alpha.empty()) return part;
    const float below = (1.0F - part) * static_cast<float>(image.alpha[pixel]) / 255.0F;
    image.alpha[pixel] = static_cast<std::uint8_t>(255.0F * (part + below) + 0.5F);
    return part / (part + below);
}

}  // namespace taut::image
