// Which scenarios a run of tests has: files and folders as named, to names and checked scenes. It plays none of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "taut/scene/load.h"
#include "taut/spec/spec.h"

namespace taut::regression {

// A golden picture that a scenario asks for.
struct GoldenRequest {
    world::Source source;
    int frame = 0;
    bool debug = false;
    bool restart = false;
    std::string camera;  // empty: that of [picture]
    world::ivec2 size{640, 360};

    // "000120", "000060-debug", "000060-side-debug": its name in the manifest and on disk.
    std::string key() const;
};

struct Scenario {
    std::string name;  // of its file, without ".toml"
    std::filesystem::path file;
    world::SceneSpec spec;
    std::vector<GoldenRequest> goldens;   // by frame
    std::vector<core::Finding> warnings;  // of the loader
};

// All "*.toml" in a folder, by name. Throws core::Error(inputOutput) for a folder without any.
std::vector<std::filesystem::path> scenarioFilesIn(const std::filesystem::path& folder);

// The named scenario files: of a folder all "*.toml" in it, by name. Throws core::Error: inputOutput for a missing file
// or a folder without any, usage if two have the same name.
std::vector<std::filesystem::path> scenarioFiles(const std::vector<std::filesystem::path>& named);

// A file that is no scenario, or one with faults.
struct UnreadScenario {
    std::string name;
    std::filesystem::path file;
    std::string fault;  // a line or more, "FILE:LINE:COLUMN: error: …"
};

struct ReadScenarios {
    std::vector<Scenario> scenarios;
    std::vector<UnreadScenario> unread;
};

// Reads all of them, even if some are faulty.
ReadScenarios readScenarios(const std::vector<std::filesystem::path>& files, const scene::LoadOptions& options);

// The goldens that a scene asks for, by frame; throws core::Error(badContent) when two have the same name, or one names
// a frame or camera that is not there.
std::vector<GoldenRequest> goldenRequests(const world::SceneSpec& spec);

}  // namespace taut::regression
