// Finds the model and texture files that a scene names, and reads the models.
#pragma once

#include "taut/scene/load.h"
#include "taut/scene/private/scene_reader.h"
#include "taut/scene/private/text_file.h"

namespace taut::scene {

// Replaces paths in the spec by the files found and fills in the meshes. A relative path is looked for in the folder of
// the file that names it, then in those of the scene and of the files on which it builds, then in each asset folder,
// its `models` and its `textures`. Reports files that are missing, not allowed or unusable.
void loadAssets(const LoadOptions& options, const Confinement& confinement, ReadScene& scene, Problems& problems);

}  // namespace taut::scene
