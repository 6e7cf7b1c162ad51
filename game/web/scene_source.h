// A scene that JavaScript gives as texts and bytes. Its files are laid into a folder of its own in the engine's memory.
#pragma once

#include <string>
#include <vector>

#include "game/web/object.h"
#include "taut/island/report.h"
#include "taut/scene/load.h"

namespace taut::web {

struct SceneSource {
    std::string text, name;              // name: of its file, for messages, "scene.toml"
    std::vector<std::string> overrides;  // "cloth.flag.cells=[72,48]"
};
SceneSource sourceIn(const Json& with);

// Reads it from the working folder. Throws core::Error.
scene::Loaded read(const SceneSource& source);

// What is measured, by the names of claims, else by those of metrics.csv, and energies [J].
Json measuresOf(const world::Metrics& metrics);
Json divergenceOf(const world::Divergence& divergence);

}  // namespace taut::web
