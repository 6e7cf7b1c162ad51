#include "game/scene_file.h"

#include <fmt/format.h>

#include <cstdio>

#include "core/error.h"
#include "game/folders.h"
#include "game/suggestion.h"
#include "pipeline/machine.h"
#include "scene/load.h"
#include "world/world.h"

namespace taut::game {
namespace {

constexpr double gigabyte = 1e9;  // [bytes]

void refuseTooLarge(const world::SceneSpec& spec) {
    const world::Estimate need = world::estimate(spec);
    const double available = pipeline::machine().memory;
    if (need.bytes <= available) return;
    throw core::Error(core::ExitCode::badContent,
                      fmt::format("{}: the scene is too large: {:.3g} points and {:.3g} springs need about {:.3g} GB, "
                                  "and this machine has {:.3g} GB",
                                  spec.file, need.points, need.springs, need.bytes / gigabyte, available / gigabyte));
}

}  // namespace

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
    refuseTooLarge(loaded.spec);
    return std::move(loaded.spec);
}

void printWarnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) fmt::print(stderr, "taut: warning: {}\n", warning);
}

}  // namespace taut::game
