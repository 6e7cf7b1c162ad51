// The generation of results. Files that keep results, or go on from them, carry it. It knows no file.
#pragma once

#include <cstdint>
#include <string>

namespace taut::world {

// A commit that changes what any scene computes, even in the last bit, raises it by one. Results without a number were
// recorded by bits 1.
inline constexpr int resultBits = 5;

inline constexpr int mostBits = 999'999'999;  // 1 … this: anything else is no such number

constexpr bool areBits(std::int64_t number) {
    return number >= 1 && number <= mostBits;
}

// "recorded by bits 1, this is bits 2".
inline std::string recordedBy(int bits, int now = resultBits) {
    return "recorded by bits " + std::to_string(bits) + ", this is bits " + std::to_string(now);
}

}  // namespace taut::world
