// Files of bytes that show their kind, their version, and whether they are complete: a mark, the version, the
// compressed content, a checksum. It knows nothing about the content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "taut/core/bytes.h"

namespace taut::pipeline {

struct SealedKind {
    std::string mark;                                    // 8 characters that every file of the kind begins with
    std::uint32_t version = 1;                           // of the content
    std::string title;                                   // "checkpoint", for messages
    std::uint32_t oldest = 0;                            // version that is still read; 0: this one only
    std::uint64_t maxContent = std::uint64_t{1} << 30U;  // [bytes] more is not unpacked
};

std::vector<std::byte> sealed(const SealedKind& kind, std::span<const std::byte> content);

// Returns the content. `name` is used in messages. Throws core::Error(badContent) for another kind or version, and for
// bytes that are cut short or damaged. Sizes that a damaged file states are checked before memory is allocated.
std::vector<std::byte> unsealed(const SealedKind& kind, std::span<const std::byte> bytes, const std::string& name);

// The same with files. A file is written completely or not at all. They also throw core::Error(inputOutput).
void writeSealed(const std::filesystem::path& path, const SealedKind& kind, std::span<const std::byte> content);
std::vector<std::byte> readSealed(const std::filesystem::path& path, const SealedKind& kind);

// The same with a value, see core::Bytes.
template <class Value>
void writeSealedValue(const std::filesystem::path& path, const SealedKind& kind, const Value& value) {
    writeSealed(path, kind, core::bytesOf(value));
}
template <class Value>
Value readSealedValue(const std::filesystem::path& path, const SealedKind& kind) {
    const std::vector<std::byte> content = readSealed(path, kind);
    try {
        return core::valueIn<Value>(content);
    } catch (const core::Error& error) {
        throw core::Error(core::ErrorKind::badContent, path.string() + ": " + error.what());
    }
}

}  // namespace taut::pipeline
