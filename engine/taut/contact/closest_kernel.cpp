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

constexpr int room = 64;  // boxes or pairs at a time

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

bool findOverlapping(const BoxLanes& boxes, const float* low, const float* high, std::uint64_t* hits) {
    std::uint64_t any = 0;
    for (int from = 0; from < boxes.n; from += 64) {
        const int n = boxes.n - from < 64 ? boxes.n - from : 64;
        std::uint64_t bits = 0;
        for (int i = 0; i < n; i += sixteen) {
            unsigned own = 0xffff;
            for (int k = 0; k < 3; ++k)
                own &= atMost(boxes.low[k] + from + i, high[k]) & atLeast(boxes.high[k] + from + i, low[k]);
            bits |= static_cast<std::uint64_t>(own) << static_cast<unsigned>(i);
        }
        *hits++ = bits;
        any |= bits;
    }
    return any != 0;
}

// Minima are computed as maxima of negative numbers, because the wide vectors only have maxima.
int findDue(CandidateRows& rows) {
    using core::TAUT_ISA::larger, core::TAUT_ISA::load;
    using V = core::TAUT_ISA::WideVector<double>;
    constexpr int width = sizeof(V) / sizeof(double);
    alignas(64) double byTravelled[room], byApproached[room];  // negative budgets of the pairs that are not due
    alignas(64) std::int64_t isDue[room];
    int count = 0;
    for (int from = 0; from < rows.n; from += room) {
        const int n = rows.n - from < room ? rows.n - from : room;
        const double *travel = rows.travelBudget + from, *approach = rows.approachBudget + from;
        const double travelled = rows.travelled, approached = rows.approached;
        // Which pairs are due. A pair that is not due counts its larger budget.
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) {
            const double left = travel[i] - travelled, leftApproach = approach[i] - approached;
            const bool hasBudget = (left > 0) | (leftApproach > 0), isFurther = left > leftApproach;
            isDue[i] = hasBudget ? 0 : 1;
            byTravelled[i] = (hasBudget & isFurther) ? -travel[i] : -1e300;
            byApproached[i] = (hasBudget & !isFurther) ? -approach[i] : -1e300;
        }
        // The least budgets: first in whole vectors, then the rest.
        int full = 0;
        if (n >= width) {
            V most = load<V>(byTravelled), mostApproach = load<V>(byApproached);
            for (full = width; full + width <= n; full += width) {
                most = larger(load<V>(byTravelled + full), most);
                mostApproach = larger(load<V>(byApproached + full), mostApproach);
            }
            for (int k = 0; k < width; ++k) {
                rows.leastTravelBudget = -larger(-rows.leastTravelBudget, most[k]);
                rows.leastApproachBudget = -larger(-rows.leastApproachBudget, mostApproach[k]);
            }
        }
        for (int i = full; i < n; ++i) {
            rows.leastTravelBudget = -larger(-rows.leastTravelBudget, byTravelled[i]);
            rows.leastApproachBudget = -larger(-rows.leastApproachBudget, byApproached[i]);
        }
        // The numbers of the due pairs, without a branch.
        for (int i = 0; i < n; ++i) {
            rows.due[count] = from + i;
            count += static_cast<int>(isDue[i]);
        }
    }
    return count;
}

}  // namespace

extern const ClosestKernels closest{onTriangles, onSegments, findOverlapping, findDue};

}  // namespace taut::contact::TAUT_ISA
