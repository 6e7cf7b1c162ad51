// A hand that leads points of bodies: where it is at each tick. It knows no island; grips live in the plans of those.
#pragma once

#include <cstdint>
#include <string>

#include "taut/world/spec.h"

namespace taut::world {

struct Hand {
    std::string id;
    bool rigid = false;
    // On the way from one place to the other during so many ticks; within a tick it moves evenly.
    dvec3 from{0.0}, to{0.0};  // [m]
    std::int64_t start = 0, length = 1;
    Ease ease = Ease::smooth;
    dvec3 rate{0.0};  // [m/s] in the tick before

    dvec3 placeAt(std::int64_t tick) const;
};

// Share of the way after so many ticks of a way that takes `length` >= 1: eased, 0 before it and 1 after it.
double shareOfWay(Ease ease, double ticks, std::int64_t length);

// Ticks that a span of time takes: the nearest whole number, at least one, since nothing is faster than a tick.
std::int64_t ticksIn(double seconds, double ticksPerSecond);

}  // namespace taut::world
