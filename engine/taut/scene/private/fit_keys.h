// Checks the numbers that a fit seeks: each is one number of the scene, within its bounds.
#pragma once

#include "taut/scene/private/scene_reader.h"

namespace taut::scene {

// Fills FitSpec::start. `root` is the document after inheritance.
void checkFitKeys(const Node& root, const std::vector<SceneSection>& sections, ReadScene& scene, Problems& problems);

}  // namespace taut::scene
