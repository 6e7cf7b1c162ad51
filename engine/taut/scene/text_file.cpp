#include "taut/scene/private/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::scene {

namespace {

[[noreturn]] void failReading(const std::filesystem::path& path, const std::string& why) {
    throw core::Error(core::ErrorKind::inputOutput, core::at({path.string()}) + why);
}

}  // namespace

std::string textFile(const std::filesystem::path& path, std::uint64_t maxBytes) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(path, code);
    if (status.type() == std::filesystem::file_type::not_found) failReading(path, "there is no such file");
    if (code) failReading(path, code.message());
    if (std::filesystem::is_directory(status)) failReading(path, "this is a folder, not a file");

    return core::fileContent(path, maxBytes);
}

std::string outsideMessage(const std::filesystem::path& file) {
    return fmt::format("{} lies outside the scene's folder and the shipped assets, and the scene is confined to them",
                       file.string());
}

bool Confinement::allows(const std::filesystem::path& file) const {
    std::error_code missing;
    const std::filesystem::path real = std::filesystem::canonical(file, missing);
    if (folders.empty() || missing) return true;
    return std::any_of(folders.begin(), folders.end(), [&](const std::filesystem::path& folder) {
        std::error_code ignored;
        const std::filesystem::path root = std::filesystem::canonical(folder.empty() ? "." : folder, ignored);
        return !ignored && std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
    });
}

}  // namespace taut::scene
