// Kernels that work on many pairs at once: closest points of points and triangles, or of segments; overlap of boxes.
// One copy for each instruction set. All copies give the same bits.
// Plain data only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace taut::contact {

inline constexpr int closestBatch = 64;  // pairs at most

// Length of a row: a batch and one cache line, so that rows do not all fall into the same cache sets.
inline constexpr int closestRow = closestBatch + 8;

struct ClosestLanes {
    alignas(64) double at[4][3][closestRow];   // [m] a point and the corners of a triangle, or the ends of two segments
    alignas(64) double way[4][3][closestRow];  // [m] of these in a block
    alignas(64) double weights[4][closestRow];     // as of a ContactConstraint
    alignas(64) double separation[3][closestRow];  // [m] from the second side to the first
    alignas(64) double distance[closestRow];       // [m]
    // Of triangles the closest Feature; of segments 1 if both places are inside, 0 if one is at an end.
    alignas(64) std::int64_t where[closestRow];
};

inline constexpr std::size_t boxesAtOnce = 16;

// Boxes in rows (n) [m]; n is a multiple of boxesAtOnce.
struct BoxLanes {
    int n;
    const float* low[3];
    const float* high[3];
};

// Two elements by their numbers.
struct ElementPair {
    int first, second;
};
// Two sets of boxes, of elements with these numbers. Bits select the boxes to test.
struct BoxSets {
    BoxLanes first, second;
    const int *firstItems, *secondItems;
    const std::uint64_t *firsts, *seconds;
    float low[3], high[3];  // [m] added to the sides of the first set's boxes
    bool areOne;            // both sets are the same: boxes are paired with those after them
};

struct ClosestKernels {
    void (*onTriangles)(ClosestLanes& lanes, int n);
    void (*onSegments)(ClosestLanes& lanes, int n);
    // hits (n / 64, rounded up) gets a bit for each box that overlaps the box from low to high (3) [m]. Returns whether
    // there is any.
    bool (*findOverlapping)(const BoxLanes& boxes, const float* low, const float* high, std::uint64_t* hits);
    // The elements of which boxes overlap, those of one word of bits of the first set -> found, which has room for 64
    // times as many as the second set has. Returns how many.
    int (*findPairs)(const BoxSets& sets, int word, ElementPair* found);
};

// For the instruction set in use.
ClosestKernels closestKernels();

}  // namespace taut::contact
