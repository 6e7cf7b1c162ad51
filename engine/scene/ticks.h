// The moments that a run has: ticks and frames, from the numbers in [run].
#pragma once

#include <cstdint>

#include "world/spec.h"

namespace taut::scene {

struct Ticks {
    double perSecond = 60.0;
    int perFrame = 1;
    std::int64_t lastFrame = 0;

    explicit Ticks(const world::RunSpec& run);

    // The tick at whose start something at t [s] happens, and whose state is the one at t.
    std::int64_t at(double t) const;
    std::int64_t last() const { return lastFrame * perFrame; }
    double secondsOf(std::int64_t tick) const { return static_cast<double>(tick) / perSecond; }  // [s]
};

}  // namespace taut::scene
