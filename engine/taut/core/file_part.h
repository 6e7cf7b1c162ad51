// A file within a file, such as a picture in a GLB. Its name is "FILE#OFFSET+LENGTH.ENDING".
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace taut::core {

std::string filePartName(const std::filesystem::path& file, std::size_t offset, std::size_t length,
                         std::string_view ending);
bool isFilePart(const std::filesystem::path& name);

// Content of a file, or of a part of it. Throws as fileContent() does, and core::Error(badContent) for a missing part.
inline constexpr std::uint64_t mostPart = std::uint64_t{64} << 20U;  // [bytes] more is no picture of a surface
std::string filePartContent(const std::filesystem::path& name, std::uint64_t maxBytes = mostPart);

}  // namespace taut::core
