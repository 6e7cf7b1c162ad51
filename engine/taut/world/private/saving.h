// A world as bytes: what its ticks have changed. The scene is not among them; it makes the world that they go into.
#pragma once

#include <span>

#include "taut/bodies/state_bytes.h"
#include "taut/spec/actions.h"

namespace taut::world {

struct WorldImpl;

// Reading, `applied` are ramps that it may have besides those of the scene.
void visit(WorldImpl& w, StateBytes& bytes, std::span<const RampAction> applied = {});

}  // namespace taut::world
