// The inner loops over pixels that run without GL, one copy per instruction set; every copy gives the same bits. Plain
// data only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace taut::render {

// A function that is linear over a tile: start + along · column + up · row, and the offset of each of four samples.
struct TileSlope {
    float start, along, up;
    float samples[4];
};

struct CoverageArgs {
    TileSlope sides[3];  // not below zero where a triangle is
    TileSlope depth;
    float toMiddle;              // depth of the middle of a pixel less that of its corner
    int left, right, low, high;  // columns and rows of the tile, the first and the last
    std::int32_t mark;
    float *nearest, *middle;  // (tile size² · 4)
    std::int32_t* marks;      // (tile size² · 4)
};

struct EdgeKernels {
    // Enters a triangle where it is nearer than the present depth. Columns beside the given ones may be entered too.
    void (*cover)(const CoverageArgs& args);

    // Whether there is an edge at pixels first … last - 1 of a row, which have neighbours to both sides. Rows below,
    // here and above.
    void (*findEdges)(const std::uint32_t* const colours[3], const float* const depths[3], int first, int last,
                      std::uint8_t* isEdge);

    // Takes the kept pixels where nothing has been drawn (the mark in the uppermost byte), and where they are nearer.
    void (*fillUndrawn)(std::size_t count, std::uint32_t mark, const std::uint32_t* kept, std::uint32_t* colours);
    void (*fillNearer)(std::size_t count, const std::uint32_t* kept, const float* keptDepths, std::uint32_t* colours,
                       float* depths);

    // Three bytes of each of four.
    void (*takeColours)(std::size_t count, const std::uint32_t* from, std::uint8_t* to);
};

// For the instruction set in use.
EdgeKernels edgeKernels();

}  // namespace taut::render
