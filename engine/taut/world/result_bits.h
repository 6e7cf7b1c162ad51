// The generation of results. Files with results carry it, and so do files from which runs go on. It knows no file.
#pragma once

#include <cstdint>
#include <string>

namespace taut::world {

// A commit that changes any result of any scene, even in the last bit, raises it by one. Results without this number
// come from bits 1.
inline constexpr int resultBits = 15;

inline constexpr int mostBits = 999'999'999;  // valid numbers are 1 … this

constexpr bool areBits(std::int64_t number) {
    return number >= 1 && number <= mostBits;
}

// "recorded by bits 1, this is bits 2".
inline std::string recordedBy(int bits, int now = resultBits) {
    return "recorded by bits " + std::to_string(bits) + ", this is bits " + std::to_string(now);
}

}  // namespace taut::world
