// A scene as studies play it.
#pragma once

#include <string_view>

#include "taut/spec/solver_spec.h"

namespace taut::world {
struct SceneSpec;
}

namespace taut::study {

// All bodies by the same method, a divergence ends the run, and every coordinate of the start is moved by up to `shift`
// [m]. The step is "auto".
world::SceneSpec byMethod(const world::SceneSpec& spec, std::string_view method, world::Precision precision,
                          double shift);

// A largest step that allows `step` itself: rounding may not cost a substep. [s]
inline double atMost(double step) {
    return step * (1 + 1e-9);
}

}  // namespace taut::study
