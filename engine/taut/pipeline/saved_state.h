// The state of a world as self-describing bytes, for programs that hold worlds: sealed like checkpoints, and read as
// carefully. They hold the state, the source of its scene and the version that made it; no code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "taut/scene/private/used_files.h"
#include "taut/spec/run_spec.h"
#include "taut/world/result_bits.h"

namespace taut::pipeline {

// Where a scene comes from.
struct SceneSource {
    bool isText = false;                 // `text` is the scene, `file` its name in messages
    std::string file;                    // as given; of a state, such that it holds in every working folder
    std::string text;                    // else empty
    std::vector<std::string> overrides;  // "cloth.flag.cells=[72,48]"
    bool isConfined = false;
};

struct SavedState {
    SceneSource source;
    std::uint64_t key = 0;  // scene::StateKeys of its tick
    std::int64_t tick = 0;
    std::vector<std::string> ramps;  // keys of the actions that apply() began
    std::vector<scene::UsedFile> files;
    std::vector<std::byte> world;  // World::save()
    int bits = world::resultBits;
};

void visit(core::Bytes& bytes, SavedState& state);

std::string toBytes(const SavedState& state);
// Throws core::Error(badContent) for other or damaged bytes, or other results bits.
SavedState fromBytes(std::string_view bytes);

// For scene::LoadOptions::stateIn: the state in a file with such bytes.
world::StartState stateIn(const std::filesystem::path& file);

}  // namespace taut::pipeline
