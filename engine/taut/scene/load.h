// The door of this folder: a scene file in, a checked world::SceneSpec out. It does not build the world.
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
    // Where models and textures are looked for when they do not lie beside the scene file: in each folder, in its
    // `models` and in its `textures`.
    std::vector<std::filesystem::path> assetFolders{};
    // Whether every file that the scene names must lie below its own folder or an asset folder, links resolved.
    bool isConfined = false;
    // Why a picture cannot be used, as a texture or as one of all that is around; empty: it can. Null: nobody looks.
    std::function<std::string(const std::filesystem::path& picture, bool isAround)> pictureFault{};
    // What a scene may be made of; null: what the engine has.
    std::shared_ptr<const world::Kinds> kinds{};
    // What a scene may take [bytes]; 0: half of the machine's memory.
    double memoryLimit = 0;
};

struct Loaded {
    world::SceneSpec spec;
    std::vector<std::string> warnings;            // file:line:col: warning: …, with the line and a caret
    StateKeys keys;                               // of stored states
    std::shared_ptr<const ActionReader> actions;  // reads more of them, for World::apply()
};

// A scene that world::World takes as it is. Throws core::Error: inputOutput if the file cannot be read; usage for an
// override without key and value; badContent for everything that is wrong with the content, all of it in the order of
// the file (of syntax errors the first), each as "file:line:col: error: …" with the line, a caret and a remedy.
Loaded loadScene(const std::filesystem::path& path, const LoadOptions& options);

// The same for a text. fileName is used in messages, and its folder to look up models and textures.
Loaded loadSceneText(std::string_view text, const std::string& fileName, const LoadOptions& options);

// Why KIND.NAME or, if points may be meant, KIND.NAME@SELECTOR names nothing in the scene, or but the body that it is
// to be measured against; empty if it does.
std::string targetFault(const world::SceneSpec& scene, const std::string& target, bool mayHavePoints,
                        const std::string& against = {});

// Why no joint of the scene has the name; empty if one has.
std::string jointFault(const world::SceneSpec& scene, const std::string& name);

// The format as a JSON schema (draft 2020-12), for editors.
std::string jsonSchema(const world::Kinds& kinds = world::builtIn());

// The format as a text to read: every section and field with unit, range, default and meaning.
std::string manual(const world::Kinds& kinds = world::builtIn());

}  // namespace taut::scene
