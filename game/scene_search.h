// The common part of taut plan and taut fit: they search values for a scene file, print the results, and write them
// into the file.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "taut/scene/private/splice.h"
#include "taut/spec/spec.h"

namespace taut::game {

struct SearchFlags {
    std::string scene, json;
    std::vector<std::string> overrides;
    bool write = false, quiet = false;
    int threads = 0;
};
// `says` is the help of the scene.
void addSearchFlags(Options& options, SearchFlags& flags, const std::string& says);

struct SearchedScene {
    std::filesystem::path file;
    std::string text;  // of the file
    world::SceneSpec spec;
};

struct Found {
    std::string summary, json;
    bool isMet = false;
    std::vector<scene::Change> changes;  // of the file
    // Is called with the changed text before it is written. May throw core::Error.
    std::function<void(const std::string& changed)> beforeWriting;
};

// Returns the exit code: that of an interruption, needNotMet, or ok. `search` may throw core::Error.
int searchScene(const SearchFlags& flags,
                const std::function<Found(const SearchedScene& scene, const std::atomic<bool>& stop)>& search);

}  // namespace taut::game
