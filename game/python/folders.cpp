#include "game/python/folders.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "taut/core/error.h"
#include "taut/fields/private/problems.h"

namespace taut::python {
namespace {

// lib/python3.11/dist-packages/taut/_taut.so, below the prefix.
std::filesystem::path prefix() {
    Dl_info info{};
    static const char inside = 0;
    if (::dladdr(&inside, &info) == 0 || info.dli_fname == nullptr) return {};
    std::filesystem::path path = std::filesystem::absolute(info.dli_fname);
    for (int up = 0; up < 5; ++up) path = path.parent_path();
    return path;
}

std::filesystem::path found(const char* variable, const char* name) {
    std::error_code ignored;
    if (const char* wish = std::getenv(variable); wish != nullptr && *wish != '\0') {
        if (!std::filesystem::is_directory(wish, ignored))
            throw core::Error(core::ErrorKind::inputOutput, fmt::format("{} names no folder: {}", variable, wish));
        return wish;
    }
    for (const std::filesystem::path& folder :
         {prefix() / "share/taut" / name, std::filesystem::path(TAUT_SOURCE_FOLDER) / name})
        if (std::filesystem::is_directory(folder, ignored)) return folder;
    return {};
}

}  // namespace

std::filesystem::path assetFolder() {
    return found("TAUT_ASSETS", "assets");
}
std::filesystem::path shaderFolder() {
    return found("TAUT_SHADERS", "shaders");
}

std::filesystem::path sceneFile(const std::string& name) {
    std::error_code ignored;
    const std::filesystem::path given(name);
    if (std::filesystem::is_regular_file(given, ignored)) return given;
    const bool isBare = name.find('/') == std::string::npos;
    const std::string stem = given.extension() == ".toml" ? given.stem().string() : name;
    std::vector<std::string> shipped;
    for (const char* folder : {"scenes", "scenarios"}) {
        const std::filesystem::path path = assetFolder() / folder;
        if (isBare && std::filesystem::is_regular_file(path / (stem + ".toml"), ignored))
            return path / (stem + ".toml");
        for (const auto& entry : std::filesystem::directory_iterator(path, ignored))
            if (entry.path().extension() == ".toml") shipped.push_back(entry.path().stem().string());
    }
    if (std::filesystem::is_directory(given, ignored))
        throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: this is a folder, not a scene file", name));
    if (std::filesystem::exists(given, ignored)) return given;
    std::ranges::sort(shipped);
    const std::string hint = isBare ? fields::suggestion(stem, shipped) : "";
    throw core::Error(core::ErrorKind::inputOutput,
                      fmt::format("{}: there is no such file{}{}", name, isBare ? " and no such shipped scene" : "",
                                  hint.empty() ? "" : "; " + hint));
}

std::string lastingName(const std::string& name, bool isText) {
    std::error_code ignored;
    if (name.empty() || !(isText || std::filesystem::is_regular_file(name, ignored))) return name;
    return std::filesystem::absolute(name).lexically_normal().string();
}

}  // namespace taut::python
