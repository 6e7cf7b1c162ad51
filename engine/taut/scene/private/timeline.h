// Checks the timeline of a scene: times, targets, hands, ramps, and actions that contradict one another.
#pragma once

#include <vector>

#include "taut/scene/private/body_index.h"
#include "taut/scene/private/scene_reader.h"

namespace taut::scene {

// Reports every fault of the actions, and resolves the keys of ramps. `root` is the document from which the scene was
// read. Expects the meshes to be loaded.
void checkTimeline(const Node& root, const std::vector<SceneSection>& sections, const BodyIndex& bodies,
                   ReadScene& scene, Problems& problems);

// Whether the run's length was overridden. If so, actions past the end are left out and are no errors.
bool isLengthOverridden(const Node& root);

}  // namespace taut::scene
