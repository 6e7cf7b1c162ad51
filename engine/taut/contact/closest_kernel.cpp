// Compiled once for each instruction set; see taut_kernel in engine/taut.cmake.
//
// It does the same operations in the same order as closest_points.h. Where that file branches, the kernel computes all
// cases and chooses one.
#include "taut/contact/closest_kernel.h"

#include <immintrin.h>

#include "taut/core/private/vectorise.h"
#include "taut/core/private/vectors.h"

namespace taut::contact::TAUT_ISA {
namespace {

// The numbers of the enum Feature.
constexpr long face = 0, edge0 = 1, edge1 = 2, edge2 = 3, corner0 = 4, corner1 = 5, corner2 = 6;

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

inline double clampShare(double s) {
    const double above = s < 0 ? 0.0 : s;
    return above > 1 ? 1.0 : above;
}

inline void sumUp(ClosestLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        double sum[3];
        for (int k = 0; k < 3; ++k)
            sum[k] = ((lanes.weights[0][i] * lanes.at[0][k][i] + lanes.weights[1][i] * lanes.at[1][k][i]) +
                      lanes.weights[2][i] * lanes.at[2][k][i]) +
                     lanes.weights[3][i] * lanes.at[3][k][i];
        lanes.separation[0][i] = sum[0];
        lanes.separation[1][i] = sum[1];
        lanes.separation[2][i] = sum[2];
        lanes.distance[i] = __builtin_sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    }
}

}  // namespace

// Ericson 2005, 5.1.5, see closest_points.h.
void onTriangles(ClosestLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double px = lanes.at[0][0][i], py = lanes.at[0][1][i], pz = lanes.at[0][2][i];
        const double ax = lanes.at[1][0][i], ay = lanes.at[1][1][i], az = lanes.at[1][2][i];
        const double bx = lanes.at[2][0][i], by = lanes.at[2][1][i], bz = lanes.at[2][2][i];
        const double cx = lanes.at[3][0][i], cy = lanes.at[3][1][i], cz = lanes.at[3][2][i];
        // Edges, the vectors from the corners to the point, and their products.
        const double abx = bx - ax, aby = by - ay, abz = bz - az, acx = cx - ax, acy = cy - ay, acz = cz - az;
        const double apx = px - ax, apy = py - ay, apz = pz - az, bpx = px - bx, bpy = py - by, bpz = pz - bz;
        const double cpx = px - cx, cpy = py - cy, cpz = pz - cz;
        const double abAp = abx * apx + aby * apy + abz * apz, acAp = acx * apx + acy * apy + acz * apz;
        const double abBp = abx * bpx + aby * bpy + abz * bpz, acBp = acx * bpx + acy * bpy + acz * bpz;
        const double abCp = abx * cpx + aby * cpy + abz * cpz, acCp = acx * cpx + acy * cpy + acz * cpz;
        const double areaC = abAp * acBp - abBp * acAp, areaB = abCp * acAp - abAp * acCp;
        const double areaA = abBp * acCp - abCp * acBp, alongB = acBp - abBp, alongC = abCp - acCp;
        // Which feature is closest: a corner, an edge, or else the face.
        const bool atA = (abAp <= 0) & (acAp <= 0), atB = (abBp >= 0) & (acBp <= abBp);
        const bool atC = (acCp >= 0) & (abCp <= acCp);
        const bool onAb = (areaC <= 0) & (abAp >= 0) & (abBp <= 0) & (abAp > abBp);
        const bool onAc = (areaB <= 0) & (acAp >= 0) & (acCp <= 0);
        const bool onBc = (areaA <= 0) & (alongB >= 0) & (alongC >= 0);
        // The weights of b and c over a common denominator. The last case comes first, so that the first case wins.
        double below = (areaA + areaB) + areaC, shareB = areaB, shareC = areaC;
        long where = face;
        const double bc = alongB + alongC, ac = acAp - acCp;
        where = onBc ? edge1 : where;
        shareC = onBc ? (bc > 0 ? alongB : 0.0) : shareC;
        below = onBc ? (bc > 0 ? bc : 1.0) : below;
        where = onAc ? edge2 : where;
        shareB = onAc ? 0.0 : shareB;
        shareC = onAc ? (ac > 0 ? acAp : 0.0) : shareC;
        below = onAc ? (ac > 0 ? ac : 1.0) : below;
        where = atC ? corner2 : where;
        shareB = atC ? 0.0 : shareB;
        shareC = atC ? 1.0 : shareC;
        below = atC ? 1.0 : below;
        where = onAb ? edge0 : where;
        shareB = onAb ? abAp : shareB;
        shareC = onAb ? 0.0 : shareC;
        below = onAb ? abAp - abBp : below;
        where = atB ? corner1 : where;
        shareB = atB ? 1.0 : shareB;
        shareC = atB ? 0.0 : shareC;
        below = atB ? 1.0 : below;
        where = atA ? corner0 : where;
        shareB = atA ? 0.0 : shareB;
        shareC = atA ? 0.0 : shareC;
        below = atA ? 1.0 : below;
        const double c = shareC / below, b = where == edge1 ? 1.0 - c : shareB / below;
        const double a = where == edge1 ? 0.0 : 1.0 - b - c;
        lanes.weights[0][i] = 1.0;
        lanes.weights[1][i] = -a;
        lanes.weights[2][i] = -b;
        lanes.weights[3][i] = -c;
        lanes.where[i] = where;
    }
    sumUp(lanes, n);
}

// closestOnSegments() of closest_points.h.
void onSegments(ClosestLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double a0x = lanes.at[0][0][i], a0y = lanes.at[0][1][i], a0z = lanes.at[0][2][i];
        const double b0x = lanes.at[2][0][i], b0y = lanes.at[2][1][i], b0z = lanes.at[2][2][i];
        const double ax = lanes.at[1][0][i] - a0x, ay = lanes.at[1][1][i] - a0y, az = lanes.at[1][2][i] - a0z;
        const double bx = lanes.at[3][0][i] - b0x, by = lanes.at[3][1][i] - b0y, bz = lanes.at[3][2][i] - b0z;
        const double rx = a0x - b0x, ry = a0y - b0y, rz = a0z - b0z;
        const double aa = ax * ax + ay * ay + az * az, bb = bx * bx + by * by + bz * bz;
        const double ab = ax * bx + ay * by + az * bz;
        const double ar = ax * rx + ay * ry + az * rz, br = bx * rx + by * ry + bz * rz;
        const bool hasA = aa > 0, hasB = bb > 0, hasBoth = hasA & hasB;
        const double det = aa * bb - ab * ab;
        // s of the lines where they are not parallel, then t, then s again if t was clamped.
        const bool isRegular = det > 1e-12 * aa * bb;
        const double overA = hasA ? aa : 1.0, overB = hasB ? bb : 1.0, over = isRegular ? det : 1.0;
        const double free = isRegular ? clampShare((ab * br - ar * bb) / over) : 0.5;
        const double beside = (ab * free + br) / overB;
        const bool isOut = (beside < 0) | (beside > 1);
        const double t = clampShare(beside);
        const double again = clampShare((ab * t - ar) / overA);
        const double s = isOut ? again : (isRegular ? free : again);
        // A segment without length is a point.
        const double onlyS = hasA ? clampShare(-ar / overA) : 0.0, onlyT = hasB ? clampShare(br / overB) : 0.0;
        const double first = hasBoth ? s : onlyS, second = hasBoth ? t : (hasA ? 0.0 : onlyT);
        lanes.weights[0][i] = 1.0 - first;
        lanes.weights[1][i] = first;
        lanes.weights[2][i] = second - 1.0;
        lanes.weights[3][i] = -second;
        const bool areInside = (first > 0) & (first < 1) & (second > 0) & (second < 1);
        lanes.where[i] = areInside ? 1L : 0L;
    }
    sumUp(lanes, n);
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
    alignas(64) long isDue[room];
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
            isDue[i] = hasBudget ? 0L : 1L;
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

}  // namespace taut::contact::TAUT_ISA
