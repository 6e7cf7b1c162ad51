// Checks the claims of a scene: each can be read, and names bodies that exist at its moments.
#pragma once

#include "taut/scene/private/body_index.h"
#include "taut/scene/private/scene_reader.h"

namespace taut::scene {

// Reports faults of [[check]] and [[golden]]. Moves the source of a check to the first character of its claim. `root`
// is the document from which the scene was read.
void checkClaims(const Node& root, const BodyIndex& bodies, ReadScene& scene, Problems& problems);

}  // namespace taut::scene
