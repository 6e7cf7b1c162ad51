// Warnings: what a scene may say but probably does not mean.
#pragma once

#include "taut/scene/private/scene_reader.h"

namespace taut::scene {

// Times off the ticks by more than 1 % of one, materials that nothing uses, a scene without bodies.
// Expects a scene without errors.
void reportSuspicions(const ReadScene& scene, Problems& problems);

}  // namespace taut::scene
