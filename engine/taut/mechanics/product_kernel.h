// Products of the springs' linearised forces with a displacement, in runs. It knows no method. There is one copy for
// each instruction set.
#pragma once

namespace taut::mechanics {

// n springs, spring i joining points i and i + offset: ±(β d + q (q·d)), d = u_b - u_a, is added to `out` of its ends.
template <class Real>
struct ProductRun {
    int n;
    int offset;        // > 0
    int stride;        // of u and out
    const Real* q[3];  // (n)
    const Real* beta;  // (n)
    const Real* u;     // planes at the run's first point a
    Real* out;         // planes at a
};

}  // namespace taut::mechanics
