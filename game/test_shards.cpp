#include "game/test_shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "game/exit_code.h"
#include "game/test_outcome.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/hash.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/sealed_file.h"
#include "taut/report/saved_report.h"
#include "taut/scene/private/used_files.h"
#include "taut/world/result_bits.h"

namespace taut::game {
namespace {

const pipeline::SealedKind kind{.mark = "tauttest", .version = 3, .title = "shard of a test"};

// Empty where it cannot be read.
std::string contentIfThere(const std::filesystem::path& path) {
    try {
        return core::fileContent(path);
    } catch (const core::Error&) {
        return "";
    }
}

// The scenarios by their files, the goldens by their manifest: wherever they lie.
std::uint64_t keyOf(const TestFlags& flags, const TestRun& run) {
    core::Hash hash;
    hash.add(static_cast<std::uint64_t>(world::resultBits));
    hash.add(std::uint64_t{flags.requireGoldens});
    for (const std::string& name : run.names) hash.add(name);
    for (const regression::Scenario& scenario : run.read.scenarios)
        for (const scene::UsedFile& file : scene::usedFiles(scenario.spec)) hash.add(file.content);
    for (const regression::UnreadScenario& scenario : run.read.unread) hash.add(contentIfThere(scenario.file));
    const std::filesystem::path manifest = run.suite.goldens.manifest();
    if (core::isThere(manifest)) hash.add(core::fileContent(manifest));
    return hash.value();
}

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& why) {
    throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: {}", folder.string(), why));
}

std::vector<std::filesystem::path> shardFiles(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("shard_") && name.ends_with(".taut") && name.find("-of-") != std::string::npos)
            files.push_back(folder / name);
    }
    std::ranges::sort(files);
    return files;
}

// Adds the parts that the text does not have yet.
void addOnce(std::string& text, const std::string& more) {
    if (more.empty() || text.find(more) != std::string::npos) return;
    text += (text.empty() ? "" : "; ") + more;
}

void addReport(report::TestReport& all, const report::TestReport& part) {
    addOnce(all.machine, part.machine);
    addOnce(all.renderer, part.renderer);
    addOnce(all.compiler, part.compiler);
    for (const std::string& note : part.notes)
        if (!core::contains(all.notes, note)) all.notes.push_back(note);
    all.scenarios.insert(all.scenarios.end(), part.scenarios.begin(), part.scenarios.end());
    all.seconds = std::max(all.seconds, part.seconds);  // side by side
}

void expectOneRun(const std::filesystem::path& folder, const std::map<std::int64_t, TestShard>& shards,
                  const std::vector<std::filesystem::path>& files) {
    const TestShard& first = shards.begin()->second;
    const auto nameOf = [&](const TestShard& shard) { return shardPath(folder, shard.piece).filename().string(); };
    for (const auto& [index, shard] : shards)
        if (shard.piece.count != first.piece.count || shard.key != first.key)
            refuse(folder, fmt::format("{} and {} are not shards of one run: other scenarios, goldens or number of "
                                       "shards; remove one of them",
                                       nameOf(first), nameOf(shard)));
    if (files.size() != shards.size())
        refuse(folder, "there are shards of two runs, of different numbers of shards; remove those of one");
    std::vector<std::string> missing;
    for (std::int64_t i = 0; i < first.piece.count; ++i)
        if (!shards.contains(i)) missing.push_back(Shard{i, first.piece.count}.text());
    if (!missing.empty())
        refuse(folder, fmt::format("shard{} {} {} missing: taut test … --shard {} plays the first of them",
                                   missing.size() == 1 ? "" : "s", fmt::join(missing, ", "),
                                   missing.size() == 1 ? "is" : "are", missing.front()));
}

}  // namespace

void visit(core::Bytes& bytes, TestShard& shard) {
    bytes(shard.piece.index, shard.piece.count, shard.key, shard.accepts, shard.hasUnread, shard.names, shard.report);
    bytes.require(shard.piece.index >= 0 && shard.piece.index < shard.piece.count);
}

void deal(const TestFlags& flags, TestRun& run) {
    run.names = namesOf(run.read);
    if (flags.shard.empty()) return;
    const Shard piece = shard(flags.shard);
    run.key = keyOf(flags, run);
    const auto count = static_cast<std::int64_t>(run.names.size());
    if (piece.count > count)
        failUsage("--shard {}: {} scenario{} cannot be divided into {}", flags.shard, count, count == 1 ? "" : "s",
                  piece.count);
    std::vector<std::size_t> order = regression::longestFirst(run.read.scenarios);
    for (std::size_t i = order.size(); i < run.names.size(); ++i) order.push_back(i);  // unreadable files cost nothing
    std::set<std::size_t> mine;
    for (auto i = static_cast<std::size_t>(piece.index); i < order.size(); i += static_cast<std::size_t>(piece.count))
        mine.insert(order[i]);
    std::size_t at = 0;
    const auto isForeign = [&](const auto&) { return !mine.contains(at++); };
    std::vector<regression::Scenario> scenarios;
    for (regression::Scenario& scenario : run.read.scenarios)
        if (!isForeign(scenario)) scenarios.push_back(std::move(scenario));
    std::vector<regression::UnreadScenario> unread;
    for (regression::UnreadScenario& scenario : run.read.unread)
        if (!isForeign(scenario)) unread.push_back(std::move(scenario));
    run.read = {std::move(scenarios), std::move(unread)};
}

std::filesystem::path shardPath(const std::filesystem::path& folder, const Shard& piece) {
    return folder / fmt::format("shard_{}-of-{}.taut", piece.index, piece.count);
}

std::vector<pipeline::RunLock> lockReport(const std::filesystem::path& folder, const TestRun& run,
                                          const std::optional<Shard>& piece) {
    const std::string name = pipeline::partyName("taut test" + (piece ? " --shard " + piece->text() : ""));
    std::vector<pipeline::RunLock> locks;
    locks.emplace_back(folder, pipeline::RunParty{piece ? std::optional(run.key) : std::nullopt, name});
    if (piece)
        locks.emplace_back(folder, pipeline::RunParty{std::nullopt, name},
                           fmt::format("shard_{}-of-{}", piece->index, piece->count));
    return locks;
}

std::optional<TestShard> storedShard(const std::filesystem::path& folder, const TestRun& run, const Shard& piece) {
    const std::filesystem::path path = shardPath(folder, piece);
    if (!core::isThere(path)) return std::nullopt;
    try {
        TestShard shard = pipeline::readSealedValue<TestShard>(path, kind);
        if (shard.key == run.key && shard.piece.index == piece.index && shard.piece.count == piece.count) return shard;
    } catch (const core::Error&) {  // damaged, it is played again
    }
    return std::nullopt;
}

int exitCodeOf(const TestShard& shard) {
    return shard.hasUnread ? static_cast<int>(ExitCode::badContent) : exitCodeOf(report::verdictOf(shard.report));
}

void writeShard(const std::filesystem::path& folder, const TestShard& shard) {
    pipeline::writeSealedValue(shardPath(folder, shard.piece), kind, shard);
}

bool hasTestShards(const std::filesystem::path& folder) {
    return !shardFiles(folder).empty();
}

TestShard joinedShards(const std::filesystem::path& folder) {
    const std::vector<std::filesystem::path> files = shardFiles(folder);
    TAUT_EXPECTS(!files.empty());
    std::map<std::int64_t, TestShard> shards;
    std::map<std::string, std::string> holders;  // of pieces, by their text
    for (const std::filesystem::path& file : files) {
        TestShard shard = pipeline::readSealedValue<TestShard>(file, kind);
        const std::string name = file.filename().string();
        if (const auto [holder, isFirst] = holders.emplace(shard.piece.text(), name); !isFirst)
            refuse(folder, fmt::format("{} holds shard {}, and so does {}; remove the copy", name, shard.piece.text(),
                                       holder->second));
        shards.emplace(shard.piece.index, std::move(shard));
    }
    expectOneRun(folder, shards, files);
    TestShard all = shards.begin()->second;
    all.report.scenarios.clear();
    for (const auto& [index, shard] : shards) {
        addReport(all.report, shard.report);
        all.hasUnread = all.hasUnread || shard.hasUnread;
    }
    const auto place = [&](const report::TestScenario& scenario) {
        return std::ranges::find(all.names, scenario.name);
    };
    std::ranges::stable_sort(all.report.scenarios, [&](const auto& a, const auto& b) { return place(a) < place(b); });
    return all;
}

}  // namespace taut::game
