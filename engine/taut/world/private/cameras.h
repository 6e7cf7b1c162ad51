// Cameras that follow bodies.
#pragma once

#include "taut/world/components.h"

namespace taut::world {

struct WorldImpl;

// Moves cameras by a tick towards the places of what they follow; bodies that are not there yet are waited for.
void followBodies(WorldImpl& w);

bool followsAny(const WorldImpl& w);

}  // namespace taut::world
