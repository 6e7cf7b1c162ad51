// The inner loops of the shadow map and of ambient occlusion, one copy per instruction set; every copy gives the same
// bits. Plain data only.
#pragma once

#include <cstdint>

namespace taut::render {

// As it lies on a map of depth, to either side of it.
struct MapTriangle {
    float x[3], y[3];  // [texels]
    float depth[3];    // 0 … 1
};

// The samples of one of several adjacent places in one direction: the columns at so many distances.
struct SkyRing {
    const float *low, *high;  // (count) height of the lowest and the highest surface [m]; low above 1000: none
    float away;               // [m]
};
inline constexpr int skyRings = 8;

struct DepthKernels {
    // Leaves in each texel (edge² from below) whose middle a triangle covers the least depth, 1 as 65535. Of rows low …
    // high only.
    void (*drawTriangles)(const MapTriangle* triangles, int count, int edge, int low, int high, std::uint16_t* map);

    // Least and largest depth (edge) of each column of so many rows.
    void (*findBounds)(const std::uint16_t* rows, int edge, int count, std::uint16_t* least, std::uint16_t* largest);

    // Adds to each of `count` places the difference of the squared sines of the elevations that the columns of one
    // direction cover, the nearest first.
    void (*addHidden)(const SkyRing (&rings)[skyRings], int count, float* hidden);
};

// For the instruction set in use.
DepthKernels depthKernels();

}  // namespace taut::render
