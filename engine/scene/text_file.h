// A whole text file in memory, or a message that says why not. It knows nothing of what the text means.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace taut::scene {

// Reads a file of at most maxBytes. Throws core::Error: inputOutput for one that is missing, a folder or
// unreadable, badContent for one that is too large.
std::string textFile(const std::filesystem::path& path, std::uint64_t maxBytes);

}  // namespace taut::scene
