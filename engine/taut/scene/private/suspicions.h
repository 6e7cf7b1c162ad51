// Warnings: valid settings that are probably mistakes.
#pragma once

#include "taut/scene/private/scene_reader.h"

namespace taut::scene {

// Times more than 1 % of a tick away from the ticks, unused materials, a scene without bodies. Expects a scene without
// errors.
void reportSuspicions(const ReadScene& scene, Problems& problems);

}  // namespace taut::scene
