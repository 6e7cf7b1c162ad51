// What holds of pairs of which one side does not yield, or is rigid, besides what holds of all.
#pragma once

#include <span>

#include "taut/contact/contact_constraint.h"
#include "taut/contact/crossings.h"

namespace taut::contact {

// Sine of the angle by which a face, or an edge at a corner, may rise beside what presses.
inline constexpr double valley = 0.2;

// Whether no edge at a corner leads nearer to what lies outward of it.
bool isCornerNearest(const Elements& elements, int point, const dvec3& outward, std::span<const dvec3> x);
// Whether neither face beside an edge does.
bool areWingsBehind(const Edge& edge, const dvec3& outward, std::span<const dvec3> x);

// What cannot go away itself, and meets what cannot, is not to be moved by a long lever beside a point that is held, or
// by none at all: whether what moves of either side has its share in the place that is pressed.
bool mayYield(const ContactConstraint& pair, std::span<const double> inverseMass);
bool mayYield(const Crossing& crossing, std::span<const double> inverseMass);

}  // namespace taut::contact
