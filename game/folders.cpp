#include "game/folders.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "taut/core/error.h"
#include "taut/render/private/font.h"

namespace taut::game {
namespace {

// `installed` in share/taut beside the program's folder, else `source` in the checkout.
std::filesystem::path installedOr(const char* installed, const char* source) {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    for (const std::filesystem::path& folder : {program.parent_path().parent_path() / "share/taut" / installed,
                                                std::filesystem::path(TAUT_SOURCE_FOLDER) / source})
        if (std::filesystem::is_directory(folder, error)) return folder;
    return {};
}

std::filesystem::path wishedOrInstalled(const char* variable, const char* name) {
    if (const char* wish = std::getenv(variable); wish != nullptr && *wish != '\0') {
        if (!std::filesystem::is_directory(wish))
            throw core::Error(core::ErrorKind::inputOutput, std::string(variable) + " names no folder: " + wish);
        return wish;
    }
    return installedOr(name, name);
}

// The names of files with this extension there, without the extension and sorted.
std::vector<std::string> namesIn(const std::filesystem::path& folder, const char* extension) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (entry.path().extension() == extension) names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

}  // namespace

std::filesystem::path assetFolder() {
    return wishedOrInstalled("TAUT_ASSETS", "assets");
}
std::filesystem::path shaderFolder() {
    return wishedOrInstalled("TAUT_SHADERS", "shaders");
}
std::filesystem::path manualFolder() {
    return installedOr("manual", "game/manual");
}

std::filesystem::path webFolder() {
    return installedOr("web", "build-web/game/web/taut");
}

std::filesystem::path fontFile() {
    const char* wish = std::getenv("TAUT_FONT");
    return wish != nullptr && *wish != '\0' ? std::filesystem::path(wish) : render::defaultFont();
}

std::filesystem::path fixedFontFile() {
    const std::filesystem::path font = fontFile(), fixed = font.parent_path() / "DejaVuSansMono.ttf";
    std::error_code ignored;
    return std::filesystem::is_regular_file(fixed, ignored) ? fixed : font;
}

std::vector<std::string> shippedScenes() {
    return namesIn(assetFolder() / "scenes", ".toml");
}
std::vector<std::string> shippedScenarios() {
    return namesIn(assetFolder() / "scenarios", ".toml");
}
std::vector<std::string> manualPages() {
    return namesIn(manualFolder(), ".md");
}

}  // namespace taut::game
