// What holds of pairs of which one side is rigid, besides what holds of all.
#pragma once

#include <span>

#include "taut/contact/crossings.h"
#include "taut/contact/meeting_pair.h"

namespace taut::contact {

// Sine of the angle by which a face, or an edge at a corner, may rise beside what presses.
inline constexpr double valley = 0.2;

// Whether no edge at a corner leads nearer to what lies outward of it.
bool isCornerNearest(const Elements& elements, int point, const dvec3& outward, std::span<const dvec3> x);
// Whether neither face beside an edge does.
bool areWingsBehind(const Edge& edge, const dvec3& outward, std::span<const dvec3> x);

// Beside a point that is held, what a rigid surface presses is not to be moved by a long lever: whether what moves has
// its share in the place that is pressed. True without a rigid side.
bool mayYield(const Elements& elements, const MeetingPair& pair, std::span<const double> inverseMass);
bool mayYield(const Elements& elements, const Crossing& crossing, std::span<const double> inverseMass);

}  // namespace taut::contact
