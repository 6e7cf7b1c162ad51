// What a run of `taut test` is of: scenarios as named and chosen, goldens, and how they are played. It plays nothing.
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
    std::vector<std::string> names;  // of all scenarios, of which this run may be a shard
    std::uint64_t key = 0;           // of all that a shard has in common with the others
    pipeline::RunLock lock;          // of the goldens, while they are changed
};

// Throws core::Error: usage for flags that do not go together and names that fit nothing, what reading goldens throws.
TestRun prepare(const TestFlags& flags);

// Of the scenarios, those that cannot be read last.
std::vector<std::string> namesOf(const regression::ReadScenarios& read);

}  // namespace taut::game
