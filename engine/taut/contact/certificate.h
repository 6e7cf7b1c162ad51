// That nothing goes through anything: a certificate for each pair, and what is done for those that have none.
#pragma once

#include <span>
#include <vector>

#include "taut/contact/contact_constraint.h"
#include "taut/contact/solver.h"

namespace taut::contact {

// Whether the sides of a pair surely did not meet on straight ways from x0 to x1 (points): for some axis all of the one
// lies above all of the other at both ends, and so in between.
bool isCertified(const ContactConstraint& pair, std::span<const dvec3> x0, std::span<const dvec3> x1);

// Whether the sides surely pass each other at nearly what they are to keep, `share` of it, though they come nearer in
// the direction in which they are nearest at first.
bool misses(const ContactConstraint& pair, std::span<const dvec3> x0, std::span<const dvec3> x1, double share);

// Of a pair without: the points of its two sides that went furthest into each other come apart, to a fifth of what they
// were, and their velocities stop approaching. It takes the approach alone and leaves the sliding (Harmon et al. 2008).
// A fifth of a fifth each instant would end where rounding decides which side they are on: 0.02 of what they keep is
// left at least. What a collider holds does not give way into it (held: ascending by point).
// Returns whether any point was moved; then both, or the one that can, are appended.
bool slideApart(const ContactConstraint& pair, std::span<const double> inverseMass,
                std::span<const KinematicContact> held, std::span<dvec3> x1, std::span<dvec3> v,
                std::vector<int>& moved);

// Points of pairs that nothing else helped, tied together: each zone goes the mean way of its mass, or that of its
// points that nothing moves (Provot 1997). In the order of the pairs; appends the points.
void moveAsImpactZones(std::span<const ContactConstraint* const> pairs, std::span<const double> inverseMass, double h,
                       std::span<const dvec3> x0, std::span<dvec3> x1, std::span<dvec3> v, std::vector<int>& moved);

}  // namespace taut::contact
