// The force that preserves the signed volume of cells, in batches. It knows no generator. There is one copy for
// each instruction set.
#pragma once

#include "taut/mechanics/private/kernel_parts.h"

namespace taut::mechanics {

template <class Real>
struct VolumeBatch {
    CornerLanes<8> lanes;
    const Real* twelfthOfBulk;          // (lanes) K/12 [Pa], 0 for a lane without a cell
    const Real* inverseRestTwelvefold;  // (lanes) 1/(12 V0) [1/m³]
    int stride;
    const Real* x;  // (3 · stride) [m]
    Real* f;        // (3 · stride) [N]; the kernel adds to it
    Real* packed;   // (8 · loosePointCount) scratch for x and forces of points of loose cells
};

}  // namespace taut::mechanics
