// Kernels that work on many pairs at once: closest points of points and triangles, or of segments; overlap of boxes;
// budgets of candidates. One copy for each instruction set. All copies give the same bits.
// Plain data only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace taut::contact {

inline constexpr int closestBatch = 64;  // pairs at most

// Length of a row: a batch and one cache line, so that rows do not all fall into the same cache sets.
inline constexpr int closestRow = closestBatch + 8;

struct ClosestLanes {
    alignas(64) double at[4][3][closestRow];  // [m] a point and the corners of a triangle, or the ends of two segments
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

// The budgets of a list's pairs (CandidateList). A pair is due when both budgets are used up.
struct CandidateRows {
    int n;
    const double* travelBudget;
    const double* approachBudget;
    double travelled, approached;
    int* due;  // (n) gets the numbers of the pairs that are due
    // [m] Least over the other pairs, of the budget that has more left.
    double leastTravelBudget = 1e300, leastApproachBudget = 1e300;
};

struct ClosestKernels {
    void (*onTriangles)(ClosestLanes& lanes, int n);
    void (*onSegments)(ClosestLanes& lanes, int n);
    // hits (n / 64, rounded up) gets a bit for each box that overlaps the box from low to high (3) [m]. Returns whether
    // there is any.
    bool (*findOverlapping)(const BoxLanes& boxes, const float* low, const float* high, std::uint64_t* hits);
    int (*findDue)(CandidateRows& rows);  // returns how many
};

// For the instruction set in use.
ClosestKernels closestKernels();

}  // namespace taut::contact
