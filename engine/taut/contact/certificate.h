// Continuous collision detection by certificate: a proof for each pair that its two sides did not pass through each
// other on straight ways from x0 to x1, and the treatment of pairs without one.
//
//      axis ^        o first side, at x0 and x1        The proof is one axis. At x0 all points of the first side are
//           |    o->-' o                               above all of the second along it, and at x1 too. A point on a
//     ------|------------------                        straight way is a mean of its two ends, so its height is a mean
//           |  o--->--o   second side                  of two heights: the first side is above at every time between.
//
// The exact answer needs the times when four points are in one plane, the roots of a cubic, and a tolerance for them
// (Provot 1997, Bridson, Fedkiw and Anderson 2002). The certificate needs sums and comparisons. It is conservative:
// with an axis the pair surely did not pass, without one it may have or not. Tests see to it that nearly all pairs that
// did not pass have an axis.
//
// Pairs without one are changed until they have one, in rounds (contact_group.h):
// - Slide apart. The points that went deepest are put back along the normal of x0, and their velocities stop closing.
//   Only the motion along the normal is taken, sliding stays (Harmon et al. 2008, "Robust treatment of simultaneous
//   collisions"). One such change may bring other pairs together, so it is repeated.
// - Impact zones. After some rounds, uncertified pairs that share points are joined to zones. Each zone moves by one
//   mean way. Inside it nothing moves against anything, so its pairs are certified (Provot 1997; Bridson et al. 2002
//   rotate zones too, here they only translate). Rounds are limited: pairs that are left are reported.
#pragma once

#include <span>
#include <vector>

#include "taut/contact/contact_constraint.h"
#include "taut/contact/solver.h"

namespace taut::contact {

// Whether the pair has a certificate from x0 to x1 (points) [m].
bool isCertified(const ContactConstraint& pair, std::span<const dvec3> x0, std::span<const dvec3> x1);

// Whether an axis keeps the sides `share` of their thickness apart, and is well turned from the pair's normal: they
// close along the normal, but pass beside each other, and need no impulse.
bool misses(const ContactConstraint& pair, std::span<const dvec3> x0, std::span<const dvec3> x1, double share);

// Moves the lowest point of the first side and the highest of the second apart along the normal, to 0.2 of the distance
// at x0, and stops their approach. Shares by inverse mass. At least 0.02 of the thickness is left: a fifth of a fifth
// every block would end in rounding. A point does not move into a collider it touches (kinematic: ascending by
// point). Returns whether anything moved; appends the points that can.
bool slideApart(const ContactConstraint& pair, std::span<const double> inverseMass,
                std::span<const KinematicContact> kinematic, std::span<dvec3> x1, std::span<dvec3> v,
                std::vector<int>& moved);

// Joins pairs that share points to zones. Each zone moves by the mean way of its mass; a zone with pinned or kinematic
// points by their mean way. Appends the points. h [s]: length of the block.
void moveAsImpactZones(std::span<const ContactConstraint* const> pairs, std::span<const double> inverseMass, double h,
                       std::span<const dvec3> x0, std::span<dvec3> x1, std::span<dvec3> v, std::vector<int>& moved);

}  // namespace taut::contact
