// Shared by the batch kernels over triangles and tetrahedra. Plain data only: kernel files are compiled once for each
// instruction set, and must not pull in an inline function of the standard library.
#pragma once

namespace taut::mechanics {

// Elements that a kernel treats at once, so that its buffers stay in the first-level cache.
inline constexpr int kernelBlock = 64;

// Elements whose corners all advance by one point from one element to the next. They need no index and no gather.
template <int Corners>
struct CornerRun {
    int first[Corners];  // points of the run's first element
    int count;           // lanes
    int lane;            // of the first element, for arrays with one value for each lane
};

// The elements of a kernel call: runs first, then loose ones with an index for each corner.
template <int Corners>
struct CornerLanes {
    const CornerRun<Corners>* runs;
    int runCount;
    const int* loosePoints;  // (loosePointCount) points of loose elements, each once
    int loosePointCount;
    const int* loose[Corners];  // (looseCount) places in loosePoints
    int looseCount;
    int looseLane;  // lane of the first loose element
};

}  // namespace taut::mechanics
