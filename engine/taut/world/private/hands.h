// Hands that lead points of bodies: where each is at each tick, and how it is turned. Their grips live in the plans of
// islands.
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
    // On the way from one place to the other during so many ticks; within a tick it moves evenly.
    dvec3 from{0.0}, to{0.0};  // [m]
    // Likewise from angles to angles, each for itself, so that it may turn several times [rad]. About x, then y, then
    // z.
    dvec3 turnedFrom{0.0}, turnedTo{0.0};
    std::int64_t start = 0, length = 1;
    Ease ease = Ease::smooth;
    dvec3 rate{0.0};  // [m/s] in the tick before
    dvec3 spin{0.0};  // [rad/s] at the end of the tick before

    dvec3 placeAt(std::int64_t tick) const;
    dvec3 anglesAt(std::int64_t tick) const;
    collision::Pose poseAt(std::int64_t tick) const;
    bool isTurned() const { return turnedFrom != dvec3(0.0) || turnedTo != dvec3(0.0); }
};

// Share of the way after so many ticks of a way that takes `length` >= 1: eased, 0 before it and 1 after it.
double shareOfWay(Ease ease, double ticks, std::int64_t length);

// Ticks that a span of time takes: the nearest whole number, at least one, since nothing is faster than a tick.
std::int64_t ticksIn(double seconds, double ticksPerSecond);

// Throws core::Error(badContent) if there is none of that name.
Hand& handOf(WorldImpl& w, const ActionSpec& action, const std::string& id);
// No point is in a grip of that hand or collider any more.
void loosen(WorldImpl& w, const std::string& holder, bool isCollider);
// Islands learn where they go in the coming tick.
void leadHands(WorldImpl& w);

}  // namespace taut::world
