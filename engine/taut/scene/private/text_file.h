// A whole text file in memory, or a message that says why not. It knows nothing of what the text means.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taut::scene {

// Reads a file of at most maxBytes. Throws core::Error: inputOutput for one that is missing, a folder or
// unreadable, badContent for one that is too large.
std::string textFile(const std::filesystem::path& path, std::uint64_t maxBytes);

// Where the files that a scene names may lie; no folders: anywhere.
struct Confinement {
    std::vector<std::filesystem::path> folders;

    // Whether a file, with all links resolved, lies below one of the folders; true for one that is not there.
    bool allows(const std::filesystem::path& file) const;
};
std::string outsideMessage(const std::filesystem::path& file);  // of one that is not allowed

}  // namespace taut::scene
