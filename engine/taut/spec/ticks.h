// The moments of a run: ticks and frames, from the numbers in [run].
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "taut/spec/run_spec.h"

namespace taut::world {

struct Ticks {
    int perFrame = 1;
    double perSecond = 60.0;
    std::int64_t firstFrame = 0, lastFrame = 0;  // the first one later where the run begins with a kept state

    explicit Ticks(const RunSpec& run)
        : perFrame(static_cast<int>(std::ceil(60.0 / run.fps))),
          perSecond(run.fps * perFrame),
          firstFrame(run.startState != nullptr ? run.startState->tick / perFrame : 0),
          lastFrame(std::max<std::int64_t>(1, std::llround(run.seconds * run.fps)) - 1) {}

    // The tick nearest to t [s]. An action at t happens at its start. The state at t is the state at its start.
    std::int64_t at(double t) const { return static_cast<std::int64_t>(std::floor(t * perSecond + 0.5)); }
    std::int64_t last() const { return lastFrame * perFrame; }
    double secondsOf(std::int64_t tick) const { return static_cast<double>(tick) / perSecond; }  // [s]
};

}  // namespace taut::world
