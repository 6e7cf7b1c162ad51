// The forces of a scene.
#pragma once

#include "taut/forces/force.h"

namespace taut::world {

struct SceneSpec;

// Gravity, winds, anchors, then the other kinds: the order in which they are added.
ForceList sceneForces(const SceneSpec& spec);

}  // namespace taut::world
