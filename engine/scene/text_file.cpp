#include "taut/scene/text_file.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <system_error>

#include "taut/core/error.h"

namespace taut::scene {

namespace {

[[noreturn]] void failReading(const std::filesystem::path& path, const std::string& why) {
    throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: error: {}", path.string(), why));
}

}  // namespace

std::string textFile(const std::filesystem::path& path, std::uint64_t maxBytes) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(path, code);
    if (status.type() == std::filesystem::file_type::not_found) failReading(path, "there is no such file");
    if (code) failReading(path, code.message());
    if (std::filesystem::is_directory(status)) failReading(path, "this is a folder, not a file");

    std::ifstream stream(path, std::ios::binary);
    if (!stream) failReading(path, "the file cannot be read");

    // The size is counted, not asked for: a device or a pipe has none.
    std::string text;
    std::array<char, 65536> buffer{};
    while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0) {
        text.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
        if (text.size() > maxBytes) {
            throw core::Error(core::ErrorKind::badContent, fmt::format("{}: error: the file is larger than {} MiB",
                                                                       path.string(), maxBytes / (1024 * 1024)));
        }
    }
    if (stream.bad()) failReading(path, "the file cannot be read to its end");
    return text;
}

}  // namespace taut::scene
