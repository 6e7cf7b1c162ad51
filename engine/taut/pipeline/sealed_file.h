// Files of bytes that say what they are, of which version, and whether they are whole: a mark, the version, the content
// compressed, a checksum. It knows nothing of the content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace taut::pipeline {

struct SealedKind {
    std::string mark;                                    // 8 characters that every file of the kind begins with
    std::uint32_t version = 1;                           // of the content
    std::string title;                                   // "checkpoint", for messages
    std::uint32_t oldest = 0;                            // version that is still read; 0: this one only
    std::uint64_t maxContent = std::uint64_t{1} << 30U;  // [bytes] more is not unpacked
};

std::vector<std::byte> sealed(const SealedKind& kind, std::span<const std::byte> content);

// The content. `name` is used in messages. Throws core::Error(badContent) for something of another kind, a version that
// is not this one, and what is cut short or damaged; nothing is allocated on the word of a damaged file.
std::vector<std::byte> unsealed(const SealedKind& kind, std::span<const std::byte> bytes, const std::string& name);

// The same with files, whole or not at all; they also throw core::Error(inputOutput).
void writeSealed(const std::filesystem::path& path, const SealedKind& kind, std::span<const std::byte> content);
std::vector<std::byte> readSealed(const std::filesystem::path& path, const SealedKind& kind);

}  // namespace taut::pipeline
