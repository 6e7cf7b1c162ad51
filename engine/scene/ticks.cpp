#include "scene/ticks.h"

#include <algorithm>
#include <cmath>

namespace taut::scene {

Ticks::Ticks(const world::RunSpec& run) {
    perFrame = static_cast<int>(std::ceil(60.0 / run.fps));
    perSecond = run.fps * perFrame;
    lastFrame = std::max<std::int64_t>(1, std::llround(run.seconds * run.fps)) - 1;
}

std::int64_t Ticks::at(double t) const {
    return static_cast<std::int64_t>(std::floor(t * perSecond + 0.5));
}

}  // namespace taut::scene
