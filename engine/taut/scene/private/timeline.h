// Checks what happens while a scene runs: times, targets, hands, ramps, and actions that contradict one another.
#pragma once

#include <vector>

#include "taut/scene/private/body_index.h"
#include "taut/scene/private/scene_reader.h"

namespace taut::scene {

// Reports every fault of the actions, and resolves the keys of ramps. `root` is the document that the
// scene was read from. Expects the meshes to be loaded.
void checkTimeline(const Node& root, const std::vector<SceneSection>& sections, const BodyIndex& bodies,
                   ReadScene& scene, Problems& problems);

// Whether the run's length was overridden: then what lies past the end is not a slip, it is left out.
bool isLengthOverridden(const Node& root);

}  // namespace taut::scene
