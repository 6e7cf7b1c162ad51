// The springs of an island, sorted for speed: runs of regular springs that need no index each, and single springs.
// It knows points by number only.
//
// The place of a spring is fixed when the network is made; its values may change later, in place. So the order of
// sums, and with it every bit of a run, depends on the springs at the start, not on the order of later changes.
#pragma once

#include <span>
#include <vector>

#include "taut/core/aligned_array.h"
#include "taut/mechanics/model.h"
#include "taut/mechanics/spring_kernels.h"

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
struct SpringSingles {
    std::vector<int> a, b;
    std::vector<Real> k, restLength, tau;
    int size() const { return static_cast<int>(a.size()); }
};

// A range of points, up to the next range. No block spans two ranges. A range that has rows of `row` points each gets
// blocks of whole rows; 0: no rows.
struct PointRange {
    int firstPoint;
    int row;
};

template <class Real>
struct SpringNetwork {
    // Bodies ascend from point 0.
    using Body = PointRange;
    SpringNetwork() = default;
    SpringNetwork(int points, std::span<const Body> bodies, std::span<const Spring> springs);

    // Takes over stiffness, rest length and damping time. Expects the springs it was made of, between the same points.
    void setSprings(std::span<const Spring> springs);

    // Takes over one spring except its damping time. Returns whether its stiffness changed.
    bool setSpring(int spring, const Spring& now);

    // Where springs stand in `order`.
    int placeOf(int spring) const { return places[spring]; }
    int placeOfRun(int run) const { return firstPlaces[run]; }
    int placeOfSingles() const { return firstPlaces.back(); }

    // Becomes a copy of `damped` without its dashpots.
    void takeUndamped(const SpringNetwork& damped);

    std::vector<SpringBlock> blocks;
    std::vector<SpringChunk> chunks;
    std::vector<SpringRun<Real>> runs;
    std::vector<Real> stiffness;  // tables of the runs, shared by content; a zero bridges a gap in a run or fills it up
    std::vector<Real> mixed;      // tables of runs whose springs have become different
    SpringSingles<Real> singles;
    std::vector<int>
        order;  // which spring stands where: those of the runs, -1 where there is none, then the single ones
    std::vector<int> places;       // (springs) in `order`
    std::vector<int> firstPlaces;  // (runs + 1)
    std::vector<bool> isOwn;       // (runs) whether no other run has its table of stiffnesses
    int springCount = 0;
    Real largestTau = 0;       // [s] of all springs
    bool isTauUniform = true;  // all have it
};

}  // namespace taut::mechanics
