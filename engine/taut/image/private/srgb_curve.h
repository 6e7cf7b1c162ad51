// Bytes of the sRGB curve (IEC 61966-2-1) to light, 0 … 1, and back; the way back is exact for every byte.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "taut/core/private/srgb.h"

namespace taut::image {

class SrgbCurve {
  public:
    SrgbCurve() {
        for (std::size_t i = 0; i < 256; ++i)
            light_[i] = static_cast<float>(core::lightOf(static_cast<double>(i) / 255.0));
        for (std::size_t i = 0; i < 255; ++i) middle_[i] = 0.5F * (light_[i] + light_[i + 1]);
    }
    float light(std::uint8_t byte) const { return light_[byte]; }
    std::uint8_t byte(float light) const {
        return static_cast<std::uint8_t>(std::upper_bound(middle_.begin(), middle_.end(), light) - middle_.begin());
    }

  private:
    std::array<float, 256> light_{};
    std::array<float, 255> middle_{};  // between one byte's light and the next's
};

}  // namespace taut::image
