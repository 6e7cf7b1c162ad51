// The changes of a scene file for a plan.
#pragma once

#include <vector>

#include "taut/scene/private/splice.h"

namespace taut::world {
struct SceneSpec;
}

namespace taut::study {

// The values in which `planned` differs from `written`, each with the key under which a scene file has it: cells and
// segments, force generators, method, step, precision. Bodies with a solver of their own get the planned one there.
std::vector<scene::Change> planChanges(const world::SceneSpec& written, const world::SceneSpec& planned);

}  // namespace taut::study
