// What covers four samples of each pixel of a tile.
#pragma once

#include <array>
#include <cstdint>

#include "taut/render/private/edge_kernels.h"
#include "taut/render/private/edge_triangles.h"

namespace taut::render {

typedef float FourFloats __attribute__((vector_size(16)));
typedef std::int32_t FourInts __attribute__((vector_size(16)));  // as a mask: all bits, or none

inline bool isAny(FourInts mask) {
    typedef std::int64_t TwoInts __attribute__((vector_size(16)));
    const auto halves = (TwoInts)mask;
    return (halves[0] | halves[1]) != 0;
}
inline FourInts chosen(FourInts mask, FourInts yes, FourInts no) {
    return (mask & yes) | (~mask & no);
}
inline FourFloats chosen(FourInts mask, FourFloats yes, FourFloats no) {
    return (FourFloats)chosen(mask, (FourInts)yes, (FourInts)no);
}
inline FourFloats fourTimes(float x) {
    return FourFloats{x, x, x, x};
}

// (edgeTileSize²) row by row from below, each of the four samples of a pixel.
struct CoveredTile {
    std::array<FourFloats, edgeTileSize * edgeTileSize> nearest;  // depth in the sample
    std::array<FourFloats, edgeTileSize * edgeTileSize> depth;    // that the same surface has in the pixel's middle
    std::array<FourInts, edgeTileSize * edgeTileSize> mark;       // 0 where nothing lies

    EdgeKernels kernels = edgeKernels();

    void clear();
    void add(const PixelBox& tile, const EdgeTriangle& triangle);
};

}  // namespace taut::render
