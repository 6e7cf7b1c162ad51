// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
//
// The cost of springs, in small: unaligned loads, a root and a division each, and stores. Its result means nothing.
#include "taut/core/private/trial_kernel.h"

#include "taut/core/private/vectors.h"

namespace taut::core::TAUT_ISA {

template <class Real>
void pullSprings(const Real* x, Real* f) {
    using V = WideVector<Real>;
    constexpr int lanes = sizeof(V) / sizeof(Real), plane = trialPoints + trialReach;
    for (int i = 0; i < trialPoints; i += lanes) {
        const V xa = load<V>(x + i), ya = load<V>(x + plane + i), za = load<V>(x + 2 * plane + i);
        V sx{}, sy{}, sz{};
        for (int offset = 1; offset < trialReach; offset += trialReach / trialOffsets) {
            const Real* b = x + offset + i;
            const V cx = xa - load<V>(b), cy = ya - load<V>(b + plane), cz = za - load<V>(b + 2 * plane);
            const V inverse = Real(1) / root(larger(cx * cx + cy * cy + cz * cz, V{} + Real(1e-30)));
            const V pull = Real(0.5) * inverse - Real(1);
            const V fx = pull * cx, fy = pull * cy, fz = pull * cz;
            store(f + offset + i, fx);
            store(f + offset + plane + i, fy);
            store(f + offset + 2 * plane + i, fz);
            sx -= fx;
            sy -= fy;
            sz -= fz;
        }
        store(f + i, sx);
        store(f + plane + i, sy);
        store(f + 2 * plane + i, sz);
    }
}
template void pullSprings(const float*, float*);
template void pullSprings(const double*, double*);

}  // namespace taut::core::TAUT_ISA
