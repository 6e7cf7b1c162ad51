// A world as bytes: the changes by its ticks. The scene is not in them; it makes the world into which they are read.
#pragma once

#include <span>

#include "taut/plan/state_bytes.h"
#include "taut/spec/actions.h"

namespace taut::world {

struct WorldImpl;

// For reading: `applied` are ramps that it may have besides those of the scene.
void visit(WorldImpl& w, StateBytes& bytes, std::span<const RampAction> applied = {});

}  // namespace taut::world
