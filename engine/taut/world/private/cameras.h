// Cameras that follow bodies.
#pragma once

#include "taut/world/components.h"

namespace taut::world {

struct WorldImpl;

// Moves cameras by a tick towards the bodies that they follow. A camera waits for a body that is not there yet.
void followBodies(WorldImpl& w);

bool followsAny(const WorldImpl& w);

}  // namespace taut::world
