// The coverage of four samples of each pixel of a tile.
#pragma once

#include <array>
#include <cstdint>

#include "taut/render/private/edge_kernels.h"
#include "taut/render/private/edge_triangles.h"

namespace taut::render {

typedef float FourFloats __attribute__((vector_size(16)));
typedef std::int32_t FourInts __attribute__((vector_size(16)));

inline bool isAny(FourInts four) {
    return (four[0] | four[1] | four[2] | four[3]) != 0;
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
