// Closest points of one pair: kernels call it in loops over many, closest_points.cpp for one. All cases are computed,
// and one is chosen: no branch keeps a loop from being vectorised.
#pragma once

#include "taut/core/private/vectors.h"

namespace taut::contact::TAUT_ISA {
namespace {

using Place = core::TAUT_ISA::Triple<double>;

// The numbers of the enum Feature.
constexpr std::int64_t face = 0, edge0 = 1, edge1 = 2, edge2 = 3, corner0 = 4, corner1 = 5, corner2 = 6;

inline double clampShare(double s) {
    const double above = s < 0 ? 0.0 : s;
    return above > 1 ? 1.0 : above;
}

// Weights as of a ContactConstraint; `where` as of ClosestLanes.
struct ClosestWeights {
    double of[4];
    std::int64_t where;
};

// By Voronoi regions: Ericson, Real-Time Collision Detection, 2005, 5.1.5. Where corners a and b are in one place, the
// edge to c is closest.
inline ClosestWeights onTriangle(const Place& p, const Place& a, const Place& b, const Place& c) {
    const Place ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double abAp = dot(ab, ap), acAp = dot(ac, ap), abBp = dot(ab, bp), acBp = dot(ac, bp);
    const double abCp = dot(ab, cp), acCp = dot(ac, cp);
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
    std::int64_t where = face;
    const double sumBc = alongB + alongC, sumAc = acAp - acCp;
    where = onBc ? edge1 : where;
    shareC = onBc ? (sumBc > 0 ? alongB : 0.0) : shareC;
    below = onBc ? (sumBc > 0 ? sumBc : 1.0) : below;
    where = onAc ? edge2 : where;
    shareB = onAc ? 0.0 : shareB;
    shareC = onAc ? (sumAc > 0 ? acAp : 0.0) : shareC;
    below = onAc ? (sumAc > 0 ? sumAc : 1.0) : below;
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
    const double weightC = shareC / below, weightB = where == edge1 ? 1.0 - weightC : shareB / below;
    const double weightA = where == edge1 ? 0.0 : 1.0 - weightB - weightC;
    return {{1.0, -weightA, -weightB, -weightC}, where};
}

// Ericson 2005, 5.1.9. Where the two are nearly parallel, any place on the first is as close as any other.
inline ClosestWeights onSegment(const Place& a0, const Place& a1, const Place& b0, const Place& b1) {
    const Place a = a1 - a0, b = b1 - b0, r = a0 - b0;
    const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), ar = dot(a, r), br = dot(b, r);
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
    const bool areInside = (first > 0) & (first < 1) & (second > 0) & (second < 1);
    return {{1.0 - first, first, second - 1.0, -second}, areInside ? 1 : 0};
}

inline Place sumOf(const ClosestWeights& weights, const Place& p, const Place& q, const Place& r, const Place& s) {
    const double* w = weights.of;
    return {((w[0] * p.x + w[1] * q.x) + w[2] * r.x) + w[3] * s.x,
            ((w[0] * p.y + w[1] * q.y) + w[2] * r.y) + w[3] * s.y,
            ((w[0] * p.z + w[1] * q.z) + w[2] * r.z) + w[3] * s.z};
}

}  // namespace
}  // namespace taut::contact::TAUT_ISA
