// Vectors of the instruction set that a kernel is compiled for, for loops that a compiler does not vectorise by itself.
// Include it in files of taut_kernel only: everything in it is TAUT_ISA's own.
#pragma once

#include <immintrin.h>

namespace taut::core::TAUT_ISA {
namespace {

#if defined(__AVX512F__)
inline constexpr int vectorBytes = 64;
#elif defined(__AVX2__)
inline constexpr int vectorBytes = 32;
#else
inline constexpr int vectorBytes = 16;
#endif

// + - * / go lane by lane, and mix with plain numbers.
template <class Real, int bytes>
struct Lanes;
template <int bytes>
struct Lanes<float, bytes> {
    typedef float Vector __attribute__((vector_size(bytes)));
};
template <int bytes>
struct Lanes<double, bytes> {
    typedef double Vector __attribute__((vector_size(bytes)));
};
template <class Real>
using WideVector = typename Lanes<Real, vectorBytes>::Vector;
template <class Real>
using NarrowVector = typename Lanes<Real, 16>::Vector;

// From and to any address. V is a vector or a number itself.
template <class V, class Real>
inline V load(const Real* from) {
    V v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
}
template <class V, class Real>
inline void store(Real* to, V v) {
    __builtin_memcpy(to, &v, sizeof v);
}

// The larger of two numbers; the second if the first is none.
inline float larger(float x, float y) {
    return x > y ? x : y;
}
inline double larger(double x, double y) {
    return x > y ? x : y;
}
inline NarrowVector<float> larger(NarrowVector<float> x, NarrowVector<float> y) {
    return _mm_max_ps(x, y);
}
inline NarrowVector<double> larger(NarrowVector<double> x, NarrowVector<double> y) {
    return _mm_max_pd(x, y);
}

inline float root(float x) {
    return __builtin_sqrtf(x);
}
inline double root(double x) {
    return __builtin_sqrt(x);
}
inline NarrowVector<float> root(NarrowVector<float> x) {
    return _mm_sqrt_ps(x);
}
inline NarrowVector<double> root(NarrowVector<double> x) {
    return _mm_sqrt_pd(x);
}
// The plain 512-bit ones make g++ 12 warn.
#if defined(__AVX512F__)
inline WideVector<float> larger(WideVector<float> x, WideVector<float> y) {
    return _mm512_maskz_max_ps(0xffff, x, y);
}
inline WideVector<double> larger(WideVector<double> x, WideVector<double> y) {
    return _mm512_maskz_max_pd(0xff, x, y);
}
inline WideVector<float> root(WideVector<float> x) {
    return _mm512_maskz_sqrt_ps(0xffff, x);
}
inline WideVector<double> root(WideVector<double> x) {
    return _mm512_maskz_sqrt_pd(0xff, x);
}
#elif defined(__AVX2__)
inline WideVector<float> larger(WideVector<float> x, WideVector<float> y) {
    return _mm256_max_ps(x, y);
}
inline WideVector<double> larger(WideVector<double> x, WideVector<double> y) {
    return _mm256_max_pd(x, y);
}
inline WideVector<float> root(WideVector<float> x) {
    return _mm256_sqrt_ps(x);
}
inline WideVector<double> root(WideVector<double> x) {
    return _mm256_sqrt_pd(x);
}
#endif

}  // namespace
}  // namespace taut::core::TAUT_ISA
