// Nearest places of a batch of points and triangles, or of segments, and which boxes overlap; one copy an instruction
// set, every copy gives the bits that closest.h gives one by one. Plain data only.
#pragma once

namespace taut::contact {

inline constexpr int closestBatch = 64;  // pairs at most

// Room for them in a row, and for a line of the cache more: rows a page separation would get in each other's way.
inline constexpr int closestRow = closestBatch + 8;

struct ClosestLanes {
    alignas(64) double at[4][3][closestRow];  // [m] a point and the corners of a triangle, or the ends of two segments
    alignas(
        64) double weights[4][closestRow];  // as of a ContactConstraint: Σ w x is the way from the second to the first
    alignas(64) double separation[3][closestRow];  // [m] that way
    alignas(64) double distance[closestRow];  // [m]
    // Of triangles the Feature that is nearest; of segments 1 if both places are within them, 0 if one is at an end.
    alignas(64) long where[closestRow];
};

// Boxes in rows (n) [m].
struct BoxLanes {
    int n;
    const double* low[3];
    const double* high[3];
};

// Pairs of a list, as there; `awake` (n) gets the numbers of those that may be near.
struct CandidateRows {
    int n;
    const double* travelBudget;
    const double* approachBudget;
    double travelled, approached;
    int* due;
    double leastTravelBudget = 1e300, leastApproachBudget = 1e300;  // [m] of the others: whichever of the two is further
};

struct ClosestKernels {
    void (*onTriangles)(ClosestLanes& lanes, int n);
    void (*onSegments)(ClosestLanes& lanes, int n);
    // `hits` (n) gets the numbers of the boxes that overlap the one from low to high (3) [m]; returns how many.
    int (*findOverlapping)(const BoxLanes& boxes, const double* low, const double* high, int* hits);
    int (*findDue)(CandidateRows& rows);  // returns how many
};

// Of the instruction set in use.
ClosestKernels closestKernels();

}  // namespace taut::contact
