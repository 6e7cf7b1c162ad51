// The interface of this folder: takes a scene file and returns a checked world::SceneSpec. It does not build the world.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "taut/scene/action_reader.h"
#include "taut/scene/state_keys.h"
#include "taut/spec/kinds.h"
#include "taut/spec/spec.h"

namespace taut::scene {

struct LoadOptions {
    // "cloth.flag.cells=[72,48]", checked like the file itself; later ones win.
    std::vector<std::string> overrides{};
    // Where to look for models and textures that are not beside the scene file: in each folder, its `models` and its
    // `textures`; and for fabrics: in its `fabrics`.
    std::vector<std::filesystem::path> assetFolders{};
    // Whether all files that the scene names must be below its own folder or an asset folder, with links resolved.
    bool isConfined = false;
    // Why a picture cannot be used as a texture or as the surroundings; empty if it can. Null: pictures are not
    // checked.
    std::function<std::string(const std::filesystem::path& picture, bool isAround)> pictureFault{};
    // Reads a file with a kept state. Throws core::Error. Null: scenes that begin with one are refused.
    std::function<world::StartState(const std::filesystem::path& file)> stateIn{};
    // Kinds that a scene may use; null: the kinds of the engine.
    std::shared_ptr<const world::Kinds> kinds{};
    // The most memory that a scene may take [bytes]; 0: half of the machine's.
    double memoryLimit = 0;
};

struct Loaded {
    world::SceneSpec spec;
    std::vector<core::Finding> warnings;          // with file, line and column
    StateKeys keys;                               // of states that are stored
    std::shared_ptr<const ActionReader> actions;  // reads further actions, for World::apply()
};

// A scene that world::World accepts. Throws core::Error: inputOutput if the file cannot be read; usage for an override
// without key and value; badContent for all faults of the content in the order of the file (of syntax errors only the
// first), each as "file:line:col: error: …" with the line, a caret and a remedy.
Loaded loadScene(const std::filesystem::path& path, const LoadOptions& options);

// The same for a text. fileName appears in messages, and models and textures are looked for in its folder.
Loaded loadSceneText(std::string_view text, const std::string& fileName, const LoadOptions& options);

// Why KIND.NAME, or KIND.NAME@SELECTOR if points are allowed, names nothing in the scene, or only the body against
// which it is to be measured. Empty if there is no fault.
std::string targetFault(const world::SceneSpec& scene, const std::string& target, bool mayHavePoints,
                        const std::string& against = {});

// Why no joint of the scene has the name; empty if there is one.
std::string jointFault(const world::SceneSpec& scene, const std::string& name);

// The format as a JSON schema (draft 2020-12), for editors.
std::string jsonSchema(const world::Kinds& kinds = world::builtIn());

// The format as text: every section and field with unit, range, default and meaning.
std::string manual(const world::Kinds& kinds = world::builtIn());

}  // namespace taut::scene
