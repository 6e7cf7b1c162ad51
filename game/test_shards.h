// Scenarios shared out to several runs of `taut test`, and what each has found put together. It plays nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "game/flags.h"
#include "game/test_suite.h"
#include "taut/pipeline/run_lock.h"
#include "taut/report/test_report.h"

namespace taut::game {

// What one shard has found, in a file of its own: "shard_2-of-8.taut".
struct TestShard {
    Shard piece;
    std::uint64_t key = 0;           // of all scenarios, their goldens and how they are judged
    std::vector<std::string> names;  // of all scenarios, in the order of the report
    std::string accepts;             // acceptBeginning()
    bool hasUnread = false;          // scenarios that cannot be read
    report::TestReport report;
};

// Leaves the scenarios of flags.shard, the longest dealt out first; run.names and run.key stay those of all. Throws
// core::Error(usage) when there are fewer scenarios than shards.
void deal(const TestFlags& flags, TestRun& run);

std::filesystem::path shardPath(const std::filesystem::path& folder, const Shard& piece);

// Locks the folder for shards of the same scenarios, and the shard in it; for a run of all scenarios it is that one's
// alone. Throws core::Error(inputOutput).
std::vector<pipeline::RunLock> lockReport(const std::filesystem::path& folder, const TestRun& run,
                                          const std::optional<Shard>& piece);

// The shard that lies there, where it is whole and of the same scenarios.
std::optional<TestShard> storedShard(const std::filesystem::path& folder, const TestRun& run, const Shard& piece);

// That taut test has for it.
int exitCodeOf(const TestShard& shard);

// Whole or not at all; throws core::Error(inputOutput).
void writeShard(const std::filesystem::path& folder, const TestShard& shard);

// Whether there is any in the folder.
bool hasTestShards(const std::filesystem::path& folder);

// All shards of a folder as one. Throws core::Error: inputOutput where some are missing or not of one run, with their
// names; badContent for one that is damaged.
TestShard joinedShards(const std::filesystem::path& folder);

}  // namespace taut::game
