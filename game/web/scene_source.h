// A scene that JavaScript gives as texts and bytes. Its files are laid into a folder of its own in the engine's memory.
#pragma once

#include <string>
#include <vector>

#include "game/web/object.h"
#include "taut/island/report.h"
#include "taut/pipeline/saved_state.h"
#include "taut/scene/load.h"

namespace taut::web {

using pipeline::SceneSource;

// Its file's name stands in messages, and other files are looked for in its folder: "scene.toml".
SceneSource sourceIn(const Json& with);

// Reads it in the working folder. Throws core::Error.
scene::Loaded read(const SceneSource& source);

// All metrics, by the names of claims, else by those of metrics.csv, and energies [J].
Json measuresOf(const world::Metrics& metrics);
Json divergenceOf(const world::Divergence& divergence);

}  // namespace taut::web
