// Hands that lead points of bodies: their place and rotation at each tick. Their grips are in the plans of islands.
#pragma once

#include <cstdint>
#include <string>

#include "taut/collision/colliders.h"
#include "taut/spec/source.h"

namespace taut::world {

struct ActionSpec;
struct WorldImpl;

struct Hand {
    std::string id;
    bool rigid = false;
    // The way from one place to another, in this number of ticks. Within a tick the hand moves evenly.
    dvec3 from{0.0}, to{0.0};  // [m]
    // Angles [rad] about x, then y, then z, on the way in the same ticks. Each goes by itself, so a hand may turn
    // several times.
    dvec3 turnedFrom{0.0}, turnedTo{0.0};
    std::int64_t start = 0, length = 1;
    Ease ease = Ease::smooth;
    dvec3 rate{0.0};  // [m/s] in the previous tick
    dvec3 spin{0.0};  // [rad/s] at the end of the previous tick

    dvec3 placeAt(std::int64_t tick) const;
    dvec3 anglesAt(std::int64_t tick) const;
    collision::Pose poseAt(std::int64_t tick) const;
    bool isTurned() const { return turnedFrom != dvec3(0.0) || turnedTo != dvec3(0.0); }
};

// Eased share of a way of `length` >= 1 ticks, after so many ticks. 0 before it and 1 after it.
double shareOfWay(Ease ease, double ticks, std::int64_t length);

// The number of ticks in a time span: the nearest whole number, at least one, as nothing is faster than a tick.
std::int64_t ticksIn(double seconds, double ticksPerSecond);

// Throws core::Error(badContent) if there is no hand of that name.
Hand& handOf(WorldImpl& w, const ActionSpec& action, const std::string& id);
// Takes all points out of the grips of that hand or collider.
void loosen(WorldImpl& w, const std::string& holder, bool isCollider);
// Tells the islands the ways of their hands in the coming tick.
void leadHands(WorldImpl& w);

}  // namespace taut::world
