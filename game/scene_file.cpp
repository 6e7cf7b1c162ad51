#include "game/scene_file.h"

#include <fmt/format.h>

#include <cstdio>

#include "core/error.h"
#include "game/folders.h"
#include "game/suggestion.h"
#include "scene/load.h"

namespace taut::game {

std::filesystem::path sceneFile(const std::string& argument) {
    const std::filesystem::path given(argument);
    if (std::filesystem::is_regular_file(given)) return given;
    if (std::filesystem::is_directory(given) && argument.find('/') != std::string::npos)
        throw core::Error(core::ExitCode::inputOutput, fmt::format("{}: this is a folder, not a scene file", argument));
    if (argument.find('/') != std::string::npos)
        throw core::Error(core::ExitCode::inputOutput, fmt::format("{}: there is no such scene file", argument));

    const std::string name = given.extension() == ".toml" ? given.stem().string() : argument;
    const std::filesystem::path shipped = assetFolder() / "scenes" / (name + ".toml");
    if (!name.empty() && std::filesystem::is_regular_file(shipped)) return shipped;
    const std::vector<std::string> scenes = shippedScenes();
    const std::string hint = didYouMean(name, scenes);
    throw core::Error(core::ExitCode::inputOutput,
                      fmt::format("{}: there is no such file and no such shipped scene{}", argument,
                                  !hint.empty() || scenes.empty()
                                      ? hint
                                      : fmt::format("; the shipped ones are {}", fmt::join(scenes, ", "))));
}

world::SceneSpec readScene(const std::string& argument, const std::vector<std::string>& overrides) {
    scene::LoadOptions options;
    options.overrides = overrides;
    if (const std::filesystem::path assets = assetFolder(); !assets.empty()) options.assetFolders.push_back(assets);
    scene::Loaded loaded = scene::loadScene(sceneFile(argument), options);
    printWarnings(loaded.warnings);
    return std::move(loaded.spec);
}

void printWarnings(const std::vector<std::string>& warnings) {
    // Those about a place in a file name it first and say themselves what they are.
    for (const std::string& warning : warnings)
        fmt::print(stderr, "{}{}\n", warning.find("warning: ") == std::string::npos ? "taut: warning: " : "", warning);
}

}  // namespace taut::game
