// The files that a scene depends on and what was in them, so that it can be said later which has changed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "taut/core/bytes.h"

namespace taut::world {
struct SceneSpec;
}

namespace taut::scene {

struct UsedFile {
    std::string path;
    std::uint64_t content = 0;  // hash of its bytes; 0: it could not be read
    bool operator==(const UsedFile&) const = default;
};

// Of a scene that was loaded: its file, the one that it builds on, meshes and textures, each once.
std::vector<UsedFile> usedFiles(const world::SceneSpec& scene);

// Of them, those that only pictures show: textures and what is around.
std::vector<UsedFile> pictureFiles(const world::SceneSpec& scene);

// Those that are not what they were: "sail.obj has changed", "sail.obj is gone".
std::vector<std::string> changedSince(std::span<const UsedFile> files);

// As bytes and back.
void addUsedFiles(core::ByteWriter& writer, std::span<const UsedFile> files);
std::vector<UsedFile> nextUsedFiles(core::ByteReader& reader);

}  // namespace taut::scene
