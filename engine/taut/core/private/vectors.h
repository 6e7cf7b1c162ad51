// Vectors of the instruction set of a kernel, for loops that a compiler does not vectorise by itself. All of it is
// local to the including file and compiled for its instruction set: that of a kernel, or the one of every processor.
#pragma once

#ifndef TAUT_ISA
#define TAUT_ISA plain
#endif

namespace taut::core::TAUT_ISA {
namespace {

#if defined(__AVX512F__)
inline constexpr int vectorBytes = 64;
#elif defined(__AVX2__)
inline constexpr int vectorBytes = 32;
#else
inline constexpr int vectorBytes = 16;
#endif

// + - * / go lane by lane, and mix with plain numbers. So do < and ==, which give a mask: all bits of a lane, or none.
// mask ? a : b chooses lane by lane.
template <class Number, int bytes>
struct Lanes {
    typedef Number Vector __attribute__((vector_size(bytes)));
};
template <class Number>
using WideVector = typename Lanes<Number, vectorBytes>::Vector;
template <class Number>
using NarrowVector = typename Lanes<Number, 16>::Vector;

// In all that follows V is a vector or a number itself.

// From and to any address.
template <class V, class Number>
inline V load(const Number* from) {
    V v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
}
template <class V, class Number>
inline void store(Number* to, V v) {
    __builtin_memcpy(to, &v, sizeof v);
}

// a where all bits of the whole numbers `mask` are set, b where none are. For masks that are no comparison, as of
// signs, it costs less than mask ? a : b. It always reads both: compilers turn a selection of numbers into masked reads
// and writes, which are slow on some processors.
template <class V, class Mask>
inline V select(Mask mask, V a, V b) {
    return __builtin_bit_cast(V, (mask & __builtin_bit_cast(Mask, a)) | (~mask & __builtin_bit_cast(Mask, b)));
}

// Whether any lane of a mask is set.
inline bool isAny(int mask) {
    return mask != 0;
}
template <class Mask>
inline bool isAny(Mask mask) {
    auto any = mask[0];
    for (unsigned k = 1; k < sizeof mask / sizeof mask[0]; ++k) any |= mask[k];
    return any != 0;
}

// The larger or the smaller of two numbers; the second if one is none.
template <class V>
inline V larger(V x, V y) {
    return x > y ? x : y;
}
template <class V>
inline V smaller(V x, V y) {
    return x < y ? x : y;
}

inline float root(float x) {
    return __builtin_sqrtf(x);
}
inline double root(double x) {
    return __builtin_sqrt(x);
}
template <class V>
inline V root(V x) {
    for (unsigned k = 0; k < sizeof x / sizeof x[0]; ++k) x[k] = root(x[k]);  // compilers see one instruction
    return x;
}
#if defined(__wasm_simd128__)  // but for this one
inline NarrowVector<float> root(NarrowVector<float> x) {
    return __builtin_wasm_sqrt_f32x4(x);
}
inline NarrowVector<double> root(NarrowVector<double> x) {
    return __builtin_wasm_sqrt_f64x2(x);
}
#endif

// A place or a way in space. V is a number, or a vector with a lane for each place.
template <class V>
struct Triple {
    V x, y, z;

    friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Triple operator*(const V& s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
    friend V dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};
template <class Mask, class V>
inline Triple<V> either(const Mask& mask, const Triple<V>& a, const Triple<V>& b) {
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

}  // namespace
}  // namespace taut::core::TAUT_ISA
