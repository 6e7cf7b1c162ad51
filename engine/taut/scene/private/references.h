// Checks the names in texts of a scene: materials, cameras, bodies and their points. It resolves nothing.
#pragma once

#include "taut/scene/private/body_index.h"
#include "taut/scene/private/scene_reader.h"

namespace taut::scene {

// Reports every reference to something missing, selectors that a body does not have, and joints between bodies with
// different [solver] overrides. Expects the meshes to be loaded.
void checkReferences(const ReadScene& scene, const BodyIndex& bodies, Problems& problems);

// Why no joint of the scene has the name.
std::optional<TargetFault> nameFault(const world::SceneSpec& scene, const std::string& name);

}  // namespace taut::scene
