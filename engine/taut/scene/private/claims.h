// Checks what is claimed of a run: that each claim can be read, and speaks of what is there at its moments.
#pragma once

#include "taut/scene/private/body_index.h"
#include "taut/scene/private/scene_reader.h"

namespace taut::scene {

// Reports faults of [[check]] and [[golden]]; takes the source of a check to the first character of its claim. `root`
// is the document that the scene was read from.
void checkClaims(const Node& root, const BodyIndex& bodies, ReadScene& scene, Problems& problems);

}  // namespace taut::scene
