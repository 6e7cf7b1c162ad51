// The state of a world as bytes that say what they are, for programs that hold worlds: sealed as checkpoints are, and
// read as carefully. They hold the state, where its scene is read from and by what it was made; no code.
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
    std::vector<std::string> ramps;  // keys of those that apply() began
    std::vector<scene::UsedFile> files;
    std::vector<std::byte> world;  // World::save()
    int bits = world::resultBits;
};

std::string toBytes(const SavedState& state);
// Throws core::Error(badContent) for what is something else, damaged or of results that are not these.
SavedState fromBytes(std::string_view bytes);

// What scene::LoadOptions::stateIn asks for: of a file with such bytes.
world::StartState stateIn(const std::filesystem::path& file);

}  // namespace taut::pipeline
