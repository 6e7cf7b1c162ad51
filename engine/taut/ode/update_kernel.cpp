// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
#include <cstdint>

#include "taut/core/private/vectorise.h"

namespace taut::ode::TAUT_ISA {
namespace {

template <class Real>
struct BitsOf;
template <>
struct BitsOf<float> {
    using Type = unsigned;
};
template <>
struct BitsOf<double> {
    using Type = std::uint64_t;
};

}  // namespace

template <class Real>
bool leapfrog(int n, const Real* a, const Real* keep, const Real* gain, Real h, Real limit, Real* x, Real* v, Real* w) {
    // Without the sign, numbers are ordered as their bits, with infinity and NaN last. Adding `room` carries into the
    // sign's place for every number from the limit on.
    using Bits = typename BitsOf<Real>::Type;
    constexpr Bits sign = Bits(1) << (8 * sizeof(Real) - 1);
    const Bits room = sign - __builtin_bit_cast(Bits, limit);
    Bits beyond = 0;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Real before = v[i];
        const Real after = keep[i] * before + gain[i] * a[i];
        v[i] = after;
        w[i] = Real(1.5) * after - Real(0.5) * before;
        x[i] += h * after;
        beyond |= (__builtin_bit_cast(Bits, after) & (sign - 1)) + room;
    }
    return (beyond & sign) == 0;
}
template bool leapfrog(int, const float*, const float*, const float*, float, float, float*, float*, float*);
template bool leapfrog(int, const double*, const double*, const double*, double, double, double*, double*, double*);

}  // namespace taut::ode::TAUT_ISA
