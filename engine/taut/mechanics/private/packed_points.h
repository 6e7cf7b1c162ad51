// Points packed as x y z 0 in one vector, for elements that jump between points. Include it only in files of
// taut_kernels, because everything in it belongs to TAUT_ISA.
#pragma once

#include "taut/core/private/vectors.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

template <class Real>
using Four = typename core::TAUT_ISA::Lanes<Real, 4 * sizeof(Real)>::Vector;

// By reference, because without AVX compilers warn about vectors of four doubles as values.
template <class Real>
inline void fetch(const Real* from, Four<Real>& v) {
    __builtin_memcpy(&v, from, sizeof v);
}
template <class Real>
inline void put(Real* to, const Four<Real>& v) {
    __builtin_memcpy(to, &v, sizeof v);
}
template <class Real>
inline void addTo(Real* sum, const Four<Real>& v) {
    Four<Real> old;
    fetch(sum, old);
    put<Real>(sum, old + v);
}

// Packs the points `of` (n) from planes. Point i goes to to[4 · each · i].
template <class Real>
inline void pack(const Real* planes, long stride, const int* of, int n, Real* to, int each = 1) {
    const Real *x = planes, *y = x + stride, *z = y + stride;
    for (int i = 0; i < n; ++i) {
        Real* point = to + 4L * each * i;
        point[0] = x[of[i]];
        point[1] = y[of[i]];
        point[2] = z[of[i]];
        point[3] = Real(0);
    }
}

// Adds packed vectors (n) to the planes at the points `of`. Each point comes once.
template <class Real>
inline void addPacked(const Real* packed, const int* of, int n, Real* planes, long stride) {
    Real *x = planes, *y = x + stride, *z = y + stride;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        x[of[i]] += packed[4 * i];
        y[of[i]] += packed[4 * i + 1];
        z[of[i]] += packed[4 * i + 2];
    }
}

// spread() puts four packed vectors into places l … l + 3 of three planes. collect() takes them back.
template <class Real, int size>
inline void spread(const Four<Real> (&of)[4], Real (&planes)[3][size], int l) {
    const Four<Real> ab = __builtin_shufflevector(of[0], of[1], 0, 4, 1, 5);
    const Four<Real> cd = __builtin_shufflevector(of[2], of[3], 0, 4, 1, 5);
    const Four<Real> abz = __builtin_shufflevector(of[0], of[1], 2, 6, 3, 7);
    const Four<Real> cdz = __builtin_shufflevector(of[2], of[3], 2, 6, 3, 7);
    put<Real>(planes[0] + l, __builtin_shufflevector(ab, cd, 0, 1, 4, 5));
    put<Real>(planes[1] + l, __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
    put<Real>(planes[2] + l, __builtin_shufflevector(abz, cdz, 0, 1, 4, 5));
}
template <class Real, int size>
inline void collect(const Real (&planes)[3][size], int l, Four<Real> (&of)[4]) {
    Four<Real> x, y, z;
    fetch(planes[0] + l, x);
    fetch(planes[1] + l, y);
    fetch(planes[2] + l, z);
    const Four<Real> zero{};
    const Four<Real> ab = __builtin_shufflevector(x, y, 0, 4, 1, 5), abz = __builtin_shufflevector(z, zero, 0, 4, 1, 5);
    const Four<Real> cd = __builtin_shufflevector(x, y, 2, 6, 3, 7), cdz = __builtin_shufflevector(z, zero, 2, 6, 3, 7);
    of[0] = __builtin_shufflevector(ab, abz, 0, 1, 4, 5);
    of[1] = __builtin_shufflevector(ab, abz, 2, 3, 6, 7);
    of[2] = __builtin_shufflevector(cd, cdz, 0, 1, 4, 5);
    of[3] = __builtin_shufflevector(cd, cdz, 2, 3, 6, 7);
}

}  // namespace
}  // namespace taut::mechanics::TAUT_ISA
