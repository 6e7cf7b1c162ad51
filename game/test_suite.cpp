#include "game/test_suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <thread>

#include "game/folders.h"
#include "game/renderers.h"
#include "game/scene_file.h"
#include "game/suggestion.h"
#include "game/test_shards.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/glob.h"
#include "taut/core/private/file_batch.h"

namespace taut::game {

std::vector<std::string> namesOf(const regression::ReadScenarios& read) {
    std::vector<std::string> names;
    for (const regression::Scenario& scenario : read.scenarios) names.push_back(scenario.name);
    for (const regression::UnreadScenario& scenario : read.unread) names.push_back(scenario.name);
    return names;
}

namespace {

// A file or folder as named, or a shipped scenario or scene of that name.
std::filesystem::path scenarioPath(const std::string& argument) {
    std::error_code ignored;
    if (std::filesystem::exists(argument, ignored) || argument.find('/') != std::string::npos) return argument;
    const std::filesystem::path shipped = assetFolder() / "scenarios" / (argument + ".toml");
    if (std::filesystem::is_regular_file(shipped, ignored)) return shipped;
    return sceneFile(argument);
}

regression::GoldenFolder goldenFolder(const TestFlags& flags, const std::vector<std::filesystem::path>& paths) {
    if (!flags.goldens.empty()) return {flags.goldens};
    std::error_code ignored;
    const std::filesystem::path& first = paths.front();
    return {(std::filesystem::is_directory(first, ignored) ? first : first.parent_path()) / "golden"};
}

// Keeps the scenarios that --filter or --update names; throws core::Error(usage) for a name that fits nothing.
void choose(const TestFlags& flags, regression::ReadScenarios& read) {
    const bool updates = !flags.updates.empty();
    const std::vector<std::string>& wanted = updates ? flags.updates : flags.filters;
    if (wanted.empty()) return;
    const auto fits = [&](const std::string& word, const std::string& name) {
        return updates ? word == name : core::matches(word, name);
    };
    const std::vector<std::string> names = namesOf(read);
    for (const std::string& word : wanted)
        if (std::ranges::none_of(names, [&](const std::string& name) { return fits(word, name); })) {
            const std::string hint = didYouMean(word, names);
            failUsage("{}: there is no scenario '{}'{}", updates ? "--update" : "--filter", word,
                      hint.empty() ? "; there are " + fmt::format("{}", fmt::join(names, ", ")) : hint);
        }
    const auto isUnwanted = [&](const auto& scenario) {
        return std::ranges::none_of(wanted, [&](const std::string& word) { return fits(word, scenario.name); });
    };
    std::erase_if(read.scenarios, isUnwanted);
    std::erase_if(read.unread, isUnwanted);
}

void checkFlags(const TestFlags& flags) {
    const bool hasWhy = flags.why.find_first_not_of(" \t\r\n") != std::string::npos;
    if (!flags.updates.empty() && !hasWhy)
        failUsage("--update changes goldens: give the reason with --why \"…\"; the manifest keeps it");
    if (flags.updates.empty() && !flags.why.empty()) failUsage("--why needs --update NAME");
    if (!flags.updates.empty() && !flags.filters.empty()) failUsage("--update names the scenarios: omit --filter");
    if (!flags.updates.empty() && flags.calibrate) failUsage("--calibrate changes no golden: omit --update");
    if (flags.resume && flags.shard.empty()) failUsage("--resume skips a finished shard: it needs --shard K/N");
    if (flags.shard.empty()) return;
    (void)shard(flags.shard);
    if (!flags.updates.empty()) failUsage("--shard changes no golden: omit --update");
    if (flags.calibrate) failUsage("--calibrate measures all scenarios: omit --shard");
    if (!flags.junit.empty())
        failUsage("a shard is not the entire report: taut join FOLDER --junit FILE writes that of all");
}

regression::DrawingOptions drawingOptions(const TestFlags& flags, int threads) {
    limitSoftwareRenderer(threads);
    regression::DrawingOptions options;
    options.shaders = shaderFolder();
    options.font = fontFile();
    GlChoice choice = glNamed(flags.gl);
    options.backends = std::move(choice.backends);
    options.device = choice.device;
    return options;
}

// The goldens of a scenario are in its folder, and no link there leads elsewhere.
void refuseLinks(const std::filesystem::path& goldens) {
    const auto refuseLink = [](const std::filesystem::path& path) {
        if (std::filesystem::is_symlink(path))
            throw core::Error(
                core::ErrorKind::badContent,
                fmt::format("{} is a link; goldens of confined scenarios may not be or contain links", path.string()));
    };
    refuseLink((goldens / "").lexically_normal().parent_path());  // not where it leads
    std::error_code none;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(goldens, none)) refuseLink(entry.path());
}

}  // namespace

TestRun prepare(const TestFlags& flags) {
    checkFlags(flags);
    TestRun run;
    for (const std::string& path : flags.paths) run.paths.push_back(scenarioPath(path));
    run.read = regression::readScenarios(regression::scenarioFiles(run.paths), loadOptions({}, flags.isConfined));
    choose(flags, run.read);
    run.suite.requiresGoldens = flags.requireGoldens;
    run.suite.goldens = goldenFolder(flags, run.paths);
    if (flags.isConfined) refuseLinks(run.suite.goldens.path);
    if (!flags.updates.empty()) {
        run.lock = pipeline::RunLock(
            run.suite.goldens.path, {std::nullopt, pipeline::partyName("taut test --update " + flags.updates.front())});
        core::FileBatch::recover(run.suite.goldens.path);
    }
    run.manifest = regression::readManifest(run.suite.goldens);
    deal(flags, run);

    const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    const int threads = flags.threads > 0 ? flags.threads : machine;
    run.suite.sideBySide = std::clamp(static_cast<int>(run.read.scenarios.size()), 1, threads);
    run.suite.threadsEach = std::max(1, threads / run.suite.sideBySide);
    run.suite.drawing = drawingOptions(flags, run.suite.threadsEach);
    return run;
}

}  // namespace taut::game
