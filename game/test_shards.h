// Distributes scenarios over several runs of `taut test`, and joins their results. It plays nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "game/flags.h"
#include "game/test_suite.h"
#include "taut/core/bytes.h"
#include "taut/pipeline/run_lock.h"
#include "taut/report/test_report.h"

namespace taut::game {

// The results of one shard, in a file of its own: "shard_2-of-8.taut".
struct TestShard {
    Shard piece;
    std::uint64_t key = 0;           // of all scenarios, their goldens and how they are judged
    std::vector<std::string> names;  // of all scenarios, in the order of the report
    std::string accepts;             // acceptBeginning()
    bool hasUnread = false;          // some scenarios cannot be read
    report::TestReport report;
};

void visit(core::Bytes& bytes, TestShard& shard);

// Keeps only the scenarios of flags.shard; the longest are dealt out first. run.names and run.key stay those of all.
// Throws core::Error(usage) if there are fewer scenarios than shards.
void deal(const TestFlags& flags, TestRun& run);

std::filesystem::path shardPath(const std::filesystem::path& folder, const Shard& piece);

// Locks the folder for shards of the same scenarios, and the shard in it. A run of all scenarios locks the folder for
// itself. Throws core::Error(inputOutput).
std::vector<pipeline::RunLock> lockReport(const std::filesystem::path& folder, const TestRun& run,
                                          const std::optional<Shard>& piece);

// The shard stored there, if it is complete and of the same scenarios.
std::optional<TestShard> storedShard(const std::filesystem::path& folder, const TestRun& run, const Shard& piece);

// The exit code of taut test for it.
int exitCodeOf(const TestShard& shard);

// Writes the whole file or nothing; throws core::Error(inputOutput).
void writeShard(const std::filesystem::path& folder, const TestShard& shard);

// Whether the folder has any shard.
bool hasTestShards(const std::filesystem::path& folder);

// Joins all shards of a folder. Throws core::Error: inputOutput, with their names, if some are missing or not of one
// run; badContent for a damaged one.
TestShard joinedShards(const std::filesystem::path& folder);

}  // namespace taut::game
