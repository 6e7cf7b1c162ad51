// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
#include "taut/contact/closest_kernel.h"

#if defined(__wasm__)
#include <wasm_simd128.h>
#else
#include <immintrin.h>
#endif

#include "taut/contact/closest_text.h"
#include "taut/core/private/vectorise.h"
#include "taut/core/private/vectors.h"

namespace taut::contact::TAUT_ISA {
namespace {

constexpr int sixteen = static_cast<int>(boxesAtOnce);

// A bit for each of sixteen numbers that is at most, or at least, the limit.
#if defined(__AVX512F__)
inline unsigned atMost(const float* numbers, float limit) {
    return _mm512_cmp_ps_mask(_mm512_loadu_ps(numbers), _mm512_set1_ps(limit), _CMP_LE_OQ);
}
inline unsigned atLeast(const float* numbers, float limit) {
    return _mm512_cmp_ps_mask(_mm512_loadu_ps(numbers), _mm512_set1_ps(limit), _CMP_GE_OQ);
}
#else
#if defined(__AVX2__)
inline unsigned bitsAtMost(const float* numbers, float limit) {
    const __m256 own = _mm256_loadu_ps(numbers);
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(own, _mm256_set1_ps(limit), _CMP_LE_OQ)));
}
inline unsigned bitsAtLeast(const float* numbers, float limit) {
    const __m256 own = _mm256_loadu_ps(numbers);
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(own, _mm256_set1_ps(limit), _CMP_GE_OQ)));
}
#elif defined(__wasm__)
inline unsigned bitsAtMost(const float* numbers, float limit) {
    return wasm_i32x4_bitmask(wasm_f32x4_le(wasm_v128_load(numbers), wasm_f32x4_splat(limit)));
}
inline unsigned bitsAtLeast(const float* numbers, float limit) {
    return wasm_i32x4_bitmask(wasm_f32x4_ge(wasm_v128_load(numbers), wasm_f32x4_splat(limit)));
}
#else
inline unsigned bitsAtMost(const float* numbers, float limit) {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(_mm_loadu_ps(numbers), _mm_set1_ps(limit))));
}
inline unsigned bitsAtLeast(const float* numbers, float limit) {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmpge_ps(_mm_loadu_ps(numbers), _mm_set1_ps(limit))));
}
#endif
constexpr int floatsAtOnce = core::TAUT_ISA::vectorBytes / static_cast<int>(sizeof(float));
inline unsigned atMost(const float* numbers, float limit) {
    unsigned bits = 0;
    for (int i = 0; i < sixteen; i += floatsAtOnce) bits |= bitsAtMost(numbers + i, limit) << static_cast<unsigned>(i);
    return bits;
}
inline unsigned atLeast(const float* numbers, float limit) {
    unsigned bits = 0;
    for (int i = 0; i < sixteen; i += floatsAtOnce) bits |= bitsAtLeast(numbers + i, limit) << static_cast<unsigned>(i);
    return bits;
}
#endif

inline Place placeOf(const ClosestLanes& lanes, int corner, int i) {
    return {lanes.at[corner][0][i], lanes.at[corner][1][i], lanes.at[corner][2][i]};
}

template <class Find>
inline void findClosest(ClosestLanes& lanes, int n, const Find& find) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Place p = placeOf(lanes, 0, i), q = placeOf(lanes, 1, i);
        const Place r = placeOf(lanes, 2, i), s = placeOf(lanes, 3, i);
        const ClosestWeights weights = find(p, q, r, s);
        const Place sum = sumOf(weights, p, q, r, s);
        for (int k = 0; k < 4; ++k) lanes.weights[k][i] = weights.of[k];
        lanes.where[i] = weights.where;
        lanes.separation[0][i] = sum.x;
        lanes.separation[1][i] = sum.y;
        lanes.separation[2][i] = sum.z;
        lanes.distance[i] = __builtin_sqrt(dot(sum, sum));
    }
}

void onTriangles(ClosestLanes& lanes, int n) {
    findClosest(
        lanes, n,
        [](const Place& p, const Place& a, const Place& b, const Place& c) { return onTriangle(p, a, b, c); });
}

void onSegments(ClosestLanes& lanes, int n) {
    findClosest(
        lanes, n, [](const Place& a, const Place& b, const Place& c, const Place& d) { return onSegment(a, b, c, d); });
}

// A bit for each of sixteen boxes that overlaps the box from low to high.
inline unsigned overlap(const BoxLanes& boxes, int at, const float* low, const float* high) {
    unsigned own = 0xffff;
    for (int k = 0; k < 3; ++k) own &= atMost(boxes.low[k] + at, high[k]) & atLeast(boxes.high[k] + at, low[k]);
    return own;
}

// A bit for each of the next 64 boxes, or fewer at the end of the row.
inline std::uint64_t overlapMany(const BoxLanes& boxes, int from, const float* low, const float* high) {
    std::uint64_t bits = 0;
    for (int i = 0; i < 64 && from + i < boxes.n; i += sixteen)
        bits |= static_cast<std::uint64_t>(overlap(boxes, from + i, low, high)) << static_cast<unsigned>(i);
    return bits;
}

bool findOverlapping(const BoxLanes& boxes, const float* low, const float* high, std::uint64_t* hits) {
    std::uint64_t any = 0;
    for (int from = 0; from < boxes.n; from += 64) any |= * hits++ = overlapMany(boxes, from, low, high);
    return any != 0;
}

int findPairs(const BoxSets& sets, int word, ElementPair* found) {
    constexpr float outwards = 2e-7F;  // at least as far out as the sum, whichever way it was rounded
    ElementPair* next = found;
    for (std::uint64_t left = sets.firsts[word]; left != 0; left &= left - 1) {
        const int i = 64 * word + __builtin_ctzll(left), own = sets.firstItems[i];
        float low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            low[k] = sets.first.low[k][i] + sets.low[k];
            high[k] = sets.first.high[k][i] + sets.high[k];
            low[k] -= outwards * __builtin_fabsf(low[k]);
            high[k] += outwards * __builtin_fabsf(high[k]);
        }
        for (int from = sets.areOne ? 64 * word : 0; from < sets.second.n; from += 64) {
            std::uint64_t bits = sets.seconds[from / 64];
            if (sets.areOne && from == 64 * word) bits &= ~std::uint64_t{1} << static_cast<unsigned>(i % 64);
            for (bits &= overlapMany(sets.second, from, low, high); bits != 0; bits &= bits - 1)
                *next++ = {own, sets.secondItems[from + __builtin_ctzll(bits)]};
        }
    }
    return static_cast<int>(next - found);
}

}  // namespace

extern const ClosestKernels closest{onTriangles, onSegments, findOverlapping, findPairs};

}  // namespace taut::contact::TAUT_ISA
