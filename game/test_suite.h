// The scope of a run of `taut test`: the chosen scenarios, their goldens, and the settings. It plays nothing.
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
    std::string output = "out/test", goldens, junit, why, gl, shard;
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

// Throws core::Error: usage for contradicting flags and names without a match, and the exceptions of reading goldens.
TestRun prepare(const TestFlags& flags);

// The names of the scenarios; unreadable ones come last.
std::vector<std::string> namesOf(const regression::ReadScenarios& read);

}  // namespace taut::game
