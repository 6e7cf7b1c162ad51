// The inner loops over pixels of what is done without GL, one copy an instruction set; every copy gives the same bits.
// Plain data only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace taut::render {

// A function that is linear over a tile: start + along · column + up · row, and what each of four samples has more.
struct TileSlope {
    float start, along, up;
    float samples[4];
};

struct CoverageArgs {
    TileSlope sides[3];  // not below zero where a triangle is
    TileSlope depth;
    float toMiddle;              // what the middle of a pixel has more depth than its corner
    int left, right, low, high;  // columns and rows of the tile, the first and the last
    std::int32_t mark;
    float *nearest, *middle;  // (tile size² · 4)
    std::int32_t* marks;      // (tile size² · 4)
};

struct EdgeKernels {
    // Enters a triangle where it is nearer than what is there. Columns beside those asked for may be entered too.
    void (*cover)(const CoverageArgs& args);

    // Whether there is an edge at pixels first … last - 1 of a row, which have neighbours to both sides. Rows below,
    // here and above.
    void (*findEdges)(const std::uint32_t* const colours[3], const float* const depths[3], int first, int last,
                      std::uint8_t* isEdge);

    // Takes what is kept where nothing has been drawn (the mark in the uppermost byte), and where it is nearer.
    void (*fillUndrawn)(std::size_t count, std::uint32_t mark, const std::uint32_t* kept, std::uint32_t* colours);
    void (*fillNearer)(std::size_t count, const std::uint32_t* kept, const float* keptDepths, std::uint32_t* colours,
                       float* depths);

    // Three bytes of each of four.
    void (*takeColours)(std::size_t count, const std::uint32_t* from, std::uint8_t* to);
};

// For the instruction set in use.
EdgeKernels edgeKernels();

}  // namespace taut::render
