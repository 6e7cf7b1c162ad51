// The springs of an island, sorted for speed: runs of regular springs that need no index each, and single springs.
// It knows points by number only.
#pragma once

#include <span>
#include <vector>

#include "taut/core/aligned_array.h"
#include "taut/mechanics/model.h"

namespace taut::mechanics {

// How points and springs are cut up; depends on the network only, never on the number of threads.
//
//   points   | block | block | block | block | block | ...      a spring belongs to the block of its lower point
//            |---- chunk 0 ----------|-- chunk 1 --- ...        chunks run side by side
//                                    |spill|                    where springs of chunk 0 reach into chunk 1
//
// When all springs of a chunk's blocks up to one are done, the forces of that block are final (but for the spill of
// the chunk before) and nobody needs its positions any more.
struct SpringBlock {
    int firstPoint, lastPoint;
    int firstRun, lastRun;
    int firstSingle, lastSingle;
    int reach;  // one past the highest point touched
};
struct SpringChunk {
    int firstBlock, lastBlock;
    int firstPoint, lastPoint;
    int spill;  // points after lastPoint that its springs touch
};

template <class Real>
struct SpringRun {
    int a;       // first point
    int offset;  // b - a
    int count;
    int table;  // where its stiffnesses begin in `stiffness`
    Real restLength, tau;
};

template <class Real>
struct SpringSingles {
    std::vector<int> a, b;
    std::vector<Real> k, restLength, tau;
    int size() const { return static_cast<int>(a.size()); }
};

template <class Real>
struct SpringNetwork {
    // Bodies are ranges of points that a block never spans, ascending from point 0. A body of rows of `row` points
    // each gets blocks of whole rows; 0 for none.
    struct Body {
        int firstPoint;
        int row;
    };
    SpringNetwork() = default;
    SpringNetwork(int points, std::span<const Body> bodies, std::span<const Spring> springs);

    std::vector<SpringBlock> blocks;
    std::vector<SpringChunk> chunks;
    std::vector<SpringRun<Real>> runs;
    std::vector<Real> stiffness;  // tables of the runs, shared by content; a zero bridges a gap in a run
    SpringSingles<Real> singles;
    int springCount = 0;
};

}  // namespace taut::mechanics
