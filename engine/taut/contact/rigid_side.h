// Which feature of a surface pushes, and the rules for pairs that have a side which is rigid or cannot move.
#pragma once

#include <span>

#include "taut/contact/contact_constraint.h"
#include "taut/contact/crossings.h"

namespace taut::contact {

// Sine of the angle by which a face beside an edge, or an edge at a corner, may rise towards the other side and still
// count as behind it.
inline constexpr double valley = 0.2;

// Whether the corner is closest to places outward of it: none of its edges rises that way.
bool isCornerNearest(const Elements& elements, int point, const dvec3& outward, std::span<const dvec3> x);
// How convex the edge is at a place on it, towards `outward`: 1 where no face beside it rises that way by half of
// `valley`, 0 where one rises by all of it, below 0 beyond, where the face is closer than the edge. Continuous, so that
// a crumpled cloth does not jitter between an edge that pushes and one that does not.
double convexityOf(const Elements& elements, const Edge& edge, const dvec3& on, const dvec3& outward,
                   std::span<const dvec3> x);
// Whether the faces beside an edge are behind it, seen from outward.
bool areWingsBehind(const Edge& edge, const dvec3& outward, std::span<const dvec3> x);

// Whether contact can move a pair: on one side, movable points have a share in the closest point. Otherwise a tiny
// share would be a long lever: a point beside a pinned one would be thrown far to move the pinned place a little.
bool mayYield(const ContactConstraint& pair, std::span<const double> inverseMass);
bool mayYield(std::span<const int> points, std::span<const double> weights, std::span<const double> inverseMass);
bool mayYield(const Crossing& crossing, std::span<const double> inverseMass);

}  // namespace taut::contact
