#include "game/scene_file.h"

#include <fmt/format.h>

#include <system_error>

#include "game/folders.h"
#include "game/messages.h"
#include "game/suggestion.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/image/private/light_image.h"
#include "taut/pipeline/saved_state.h"
#include "taut/scene/load.h"

namespace taut::game {

std::filesystem::path sceneFile(const std::string& argument) {
    const std::filesystem::path given(argument);
    std::error_code ignored;  // a file that may not be looked at is reported when it is read
    if (std::filesystem::is_regular_file(given, ignored)) return given;
    const bool hasFolder = argument.find('/') != std::string::npos;
    const std::string name = given.extension() == ".toml" ? given.stem().string() : argument;
    for (const char* folder : {"scenes", "scenarios"}) {
        const std::filesystem::path shipped = assetFolder() / folder / (name + ".toml");
        if (!hasFolder && !name.empty() && std::filesystem::is_regular_file(shipped, ignored)) return shipped;
    }

    if (std::filesystem::is_directory(given, ignored))
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{}: this is a folder, not a scene file", argument));
    if (std::filesystem::exists(given, ignored) || ignored == std::errc::permission_denied) return given;
    if (hasFolder)
        throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: there is no such scene file", argument));
    const std::vector<std::string> scenes = shippedScenes();
    const std::string hint = didYouMean(name, scenes);
    throw core::Error(core::ErrorKind::inputOutput,
                      fmt::format("{}: there is no such file and no such shipped scene{}", argument,
                                  !hint.empty() || scenes.empty()
                                      ? hint
                                      : fmt::format("; the shipped ones are {}", fmt::join(scenes, ", "))));
}

namespace {

std::string pictureFault(const std::filesystem::path& picture, bool isAround) {
    try {
        if (isAround)
            image::expectAllAround(picture, image::lightImageSize(picture));
        else
            image::readImage(picture);
        return "";
    } catch (const core::Error& error) {
        return error.what();
    }
}

}  // namespace

world::SceneSpec readScene(const std::string& argument, const std::vector<std::string>& overrides, bool isConfined) {
    return readSceneWithKeys(argument, overrides, isConfined).spec;
}

void addOverrideFlag(Options& options, std::vector<std::string>& overrides, const std::string& help) {
    options.value("--set", overrides, help).typeName("KEY=VALUE").oneValue();
}

void addConfinedFlag(Options& options, bool& isConfined) {
    options.flag("--confined", isConfined, "Read only files below the scene's folder and the shipped assets");
}

std::string referenceTo(const std::filesystem::path& scene, const std::filesystem::path& folder) {
    std::error_code ignored;
    const auto whole = [&](const std::filesystem::path& path) {
        return std::filesystem::weakly_canonical(path, ignored);
    };
    const std::filesystem::path real = whole(scene), from = whole(folder.empty() ? "." : folder);
    if (real.parent_path() == whole(assetFolder() / "scenes")) return "shipped:" + real.stem().string();
    if (real.parent_path() == whole(assetFolder() / "scenarios")) return "shipped:scenarios/" + real.stem().string();
    return std::filesystem::relative(real, from, ignored).string();
}

scene::LoadOptions loadOptions(const std::vector<std::string>& overrides, bool isConfined) {
    scene::LoadOptions options;
    options.isConfined = isConfined;
    options.overrides = overrides;
    options.pictureFault = pictureFault;
    options.stateIn = pipeline::stateIn;
    if (const std::filesystem::path assets = assetFolder(); !assets.empty()) options.assetFolders.push_back(assets);
    return options;
}

scene::Loaded readSceneWithKeys(const std::string& argument, const std::vector<std::string>& overrides,
                                bool isConfined) {
    scene::Loaded loaded = scene::loadScene(sceneFile(argument), loadOptions(overrides, isConfined));
    printWarnings(loaded.warnings);
    return loaded;
}

std::string preparationText(const world::SceneSpec& spec) {
    constexpr std::size_t many = 40'000;   // triangles, of which a processor prepares some 150 000 in a second
    constexpr double manyPoints = 50'000;  // of a block, of which it prepares some 20 000
    std::vector<std::string> large;
    const auto look = [&](const world::ColliderSpec& collider, const std::string& name, const auto& self) -> void {
        for (const world::ColliderSpec& part : collider.parts) self(part, name, self);
        if (collider.meshData != nullptr && collider.meshData->triangles.size() >= many)
            large.push_back(fmt::format("{}: {} triangles", name, collider.meshData->triangles.size()));
    };
    for (const world::ColliderSpec& collider : spec.colliders) look(collider, "collider." + collider.name, look);
    for (const world::BodySpec& body : spec.bodies)
        if (const double points = body.outline(spec).points; points >= manyPoints)
            large.push_back(fmt::format("{}: {:.0f} points", body.fullName(), points));
    return large.empty() ? "" : fmt::format("preparing {}", fmt::join(large, ", "));
}

void notePreparation(const world::SceneSpec& spec) {
    if (const std::string text = preparationText(spec); !text.empty()) printNote("note: {}\n", text);
}

void expectWritable(const std::filesystem::path& file, const world::SceneSpec& spec,
                    const std::vector<std::string>& overrides) {
    if (!overrides.empty()) failUsage("--write and --set exclude each other: the values would not fit the file");
    if (!spec.bases.empty())
        failUsage(
            "{}: --write needs a scene that is one file; this one builds on {}: use that, or omit --write and copy the "
            "values",
            file.string(), spec.bases.front());
}

void replaceSceneFile(const std::filesystem::path& file, const std::string& expected, const std::string& content) {
    if (core::fileContent(file) != expected)
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{}: the file has changed meanwhile; nothing is written", file.string()));
    std::error_code ignored;
    const std::filesystem::path real = std::filesystem::canonical(file, ignored);
    const std::filesystem::perms permissions = std::filesystem::status(file, ignored).permissions();
    core::writeWholeFile(ignored ? file : real, content);
    std::filesystem::permissions(ignored ? file : real, permissions, ignored);
}

}  // namespace taut::game
