// The shift of a start by which a horizon is found: the same for every run, another for every coordinate.
#pragma once

#include <cstdint>

namespace taut::study {

// -1 … 1, from the number of a point and a coordinate.
inline double perturbationOf(int point, int coordinate) {
    std::uint64_t bits = static_cast<std::uint64_t>(point) * 3U + static_cast<std::uint64_t>(coordinate) + 1U;
    bits *= 0x9e3779b97f4a7c15ULL;  // spreads neighbours (Weyl sequence of the golden ratio)
    bits ^= bits >> 29;
    bits *= 0xbf58476d1ce4e5b9ULL;
    bits ^= bits >> 32;
    return static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
}

}  // namespace taut::study
