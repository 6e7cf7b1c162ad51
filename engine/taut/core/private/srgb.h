// The sRGB curve (IEC 61966-2-1).
#pragma once

#include <cmath>

namespace taut::core {

// Of a channel 0 … 1 as it is written, its light, 0 … 1.
inline double lightOf(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace taut::core
