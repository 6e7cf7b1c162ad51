#include "game/folders.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "taut/core/error.h"
#include "taut/render/font.h"

namespace taut::game {
namespace {

std::filesystem::path found(const char* variable, const char* name) {
    if (const char* wish = std::getenv(variable); wish != nullptr && *wish != '\0') {
        if (!std::filesystem::is_directory(wish))
            throw core::Error(core::ErrorKind::inputOutput, std::string(variable) + " names no folder: " + wish);
        return wish;
    }
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path installed = program.parent_path().parent_path() / "share/taut" / name;
    const std::filesystem::path checkout = std::filesystem::path(TAUT_SOURCE_FOLDER) / name;
    for (const std::filesystem::path& folder : {installed, checkout})
        if (std::filesystem::is_directory(folder, error)) return folder;
    return {};
}

std::vector<std::string> shippedIn(const char* folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(assetFolder() / folder, error))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

std::filesystem::path assetFolder() {
    return found("TAUT_ASSETS", "assets");
}
std::filesystem::path shaderFolder() {
    return found("TAUT_SHADERS", "shaders");
}

std::filesystem::path fontFile() {
    const char* wish = std::getenv("TAUT_FONT");
    return wish != nullptr && *wish != '\0' ? std::filesystem::path(wish) : render::defaultFont();
}

std::vector<std::string> shippedScenes() {
    return shippedIn("scenes");
}
std::vector<std::string> shippedScenarios() {
    return shippedIn("scenarios");
}

}  // namespace taut::game
