// What the joints of a scene tie, and what they name and do not tie.
#pragma once

#include <vector>

#include "taut/bodies/island_plan.h"

namespace taut::world {

struct WorldImpl;

// Tells of them as they tied bodies, and of those with colliders.
void takeJoints(WorldImpl& w, const std::vector<JointReport>& reports);

}  // namespace taut::world
