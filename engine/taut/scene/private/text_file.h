// Reads a whole text file, or says why it cannot. It knows nothing of the text's meaning.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taut::scene {

// Reads a file of at most maxBytes. Throws core::Error: inputOutput for a file that is missing, a folder or unreadable;
// badContent for one that is too large.
std::string textFile(const std::filesystem::path& path, std::uint64_t maxBytes);

// Folders in which the files that a scene names must lie; none: anywhere.
struct Confinement {
    std::vector<std::filesystem::path> folders;

    // Whether a file, with all links resolved, lies below one of the folders. True for a missing file.
    bool allows(const std::filesystem::path& file) const;
};
std::string outsideMessage(const std::filesystem::path& file);  // for a file that is not allowed

}  // namespace taut::scene
