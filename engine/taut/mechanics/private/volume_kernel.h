// The force that preserves the signed volume of tetrahedra, in batches. It knows no generator. There is one copy for
// each instruction set.
#pragma once

#include "taut/mechanics/private/kernel_parts.h"

namespace taut::mechanics {

template <class Real>
struct VolumeBatch {
    CornerLanes<4> lanes;
    const Real* sixthOfBulk;       // (lanes) K/6 [Pa], 0 for a lane without a tetrahedron
    const Real* inverseRestSixth;  // (lanes) 1/(6 V0) [1/m³]
    int stride;
    const Real* x;  // (3 · stride) [m]
    Real* f;        // (3 · stride) [N]; the kernel adds to it
    Real* packed;   // (8 · loosePointCount) scratch for x and forces of points of loose tetrahedra
};

namespace sse2 {
void addVolume(const VolumeBatch<float>& batch);
void addVolume(const VolumeBatch<double>& batch);
}  // namespace sse2
namespace avx2 {
void addVolume(const VolumeBatch<float>& batch);
void addVolume(const VolumeBatch<double>& batch);
}  // namespace avx2
namespace avx512 {
void addVolume(const VolumeBatch<float>& batch);
void addVolume(const VolumeBatch<double>& batch);
}  // namespace avx512

}  // namespace taut::mechanics
