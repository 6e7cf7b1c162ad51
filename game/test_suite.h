// What a run of `taut test` covers: the chosen scenarios, their goldens, and how they are played. It plays nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "taut/pipeline/run_lock.h"
#include "taut/regression/manifest.h"
#include "taut/regression/scenario.h"
#include "taut/regression/suite.h"

namespace taut::game {

struct TestFlags {
    std::vector<std::string> paths, filters, updates;
    std::string output = "out/test", goldens, junit, why, gl, isa, shard;
    int threads = 0;
    bool quiet = false, calibrate = false, requireGoldens = false, isConfined = false, resume = false;
};

struct TestRun {
    std::vector<std::filesystem::path> paths;
    regression::ReadScenarios read;
    regression::SuiteOptions suite;
    regression::Manifest manifest;
    std::vector<std::string> names;  // of all scenarios; this run may be a shard of them
    std::uint64_t key = 0;           // of all that shards have in common
    pipeline::RunLock lock;          // of the goldens, while they change
};

// Throws core::Error: usage for flags that do not go together and names that match nothing, and what reading goldens
// throws.
TestRun prepare(const TestFlags& flags);

// The names of the scenarios; those that cannot be read come last.
std::vector<std::string> namesOf(const regression::ReadScenarios& read);

}  // namespace taut::game
