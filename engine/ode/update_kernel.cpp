// Compiled once for each instruction set; see taut_kernel in engine/taut.cmake.
#include "taut/core/vectorise.h"

namespace taut::ode::TAUT_ISA {
namespace {

template <class Real>
inline void leapfrog(int n, const Real* a, const Real* keep, const Real* gain, Real h, Real* x, Real* v, Real* w) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Real before = v[i];
        const Real after = keep[i] * before + gain[i] * a[i];
        v[i] = after;
        w[i] = Real(1.5) * after - Real(0.5) * before;
        x[i] += h * after;
    }
}

}  // namespace

void leapfrogFloat(int n, const float* a, const float* keep, const float* gain, float h, float* x, float* v, float* w) {
    leapfrog(n, a, keep, gain, h, x, v, w);
}
void leapfrogDouble(int n, const double* a, const double* keep, const double* gain, double h, double* x, double* v,
                    double* w) {
    leapfrog(n, a, keep, gain, h, x, v, w);
}

}  // namespace taut::ode::TAUT_ISA
