// The files on which a scene depends, with their contents, to tell later which have changed.
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

// For a loaded scene: its file, the file on which it builds, meshes and textures, each once.
std::vector<UsedFile> usedFiles(const world::SceneSpec& scene);

// Those of the files that only pictures show: textures and surroundings.
std::vector<UsedFile> pictureFiles(const world::SceneSpec& scene);

// The files that differ now: "sail.obj has changed", "sail.obj is gone".
std::vector<std::string> changedSince(std::span<const UsedFile> files);

inline void visit(core::Bytes& bytes, UsedFile& file) {
    bytes(file.path, file.content);
}

}  // namespace taut::scene
