#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/calibration_run.h"
#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/interruption.h"
#include "game/live_line.h"
#include "game/messages.h"
#include "game/renderers.h"
#include "game/run_part.h"
#include "game/scene_file.h"
#include "game/test_outcome.h"
#include "game/test_shards.h"
#include "game/test_suite.h"
#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/parallel.h"
#include "taut/core/private/stopwatch.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/machine.h"
#include "taut/regression/goldens.h"
#include "taut/regression/judging.h"
#include "taut/regression/suite.h"

namespace taut::game {
namespace {

report::TestReport blankReport(const TestRun& run) {
    const pipeline::Machine machine = pipeline::machine();
    report::TestReport report;
    report.program = machine.program;
    report.compiler = machine.compiler;
    report.machine = fmt::format("{}, {}", machine.processor, machine.simd);
    report.tolerance = fmt::format("A picture passes if {}. A state passes if it is right to the last bit.",
                                   regression::inWords(run.manifest.tolerance));
    return report;
}

// Goldens of removed scenarios; reported if all of the folders' scenarios were looked for.
std::vector<std::string> orphans(const TestFlags& flags, const TestRun& run) {
    std::vector<std::string> notes;
    std::error_code ignored;
    for (const std::filesystem::path& path : run.paths)
        if (!flags.filters.empty() || !std::filesystem::is_directory(path, ignored)) return notes;
    std::vector<std::string> names;
    for (const auto& [name, goldens] : run.manifest.scenarios)
        if (!core::contains(run.names, name)) names.push_back(name);
    if (!names.empty())
        notes.push_back(fmt::format("{}: there are goldens of scenarios that are not in {}: {}",
                                    run.suite.goldens.manifest().string(), fmt::join(flags.paths, ", "),
                                    fmt::join(names, ", ")));
    return notes;
}

// Scenarios that had not ended at an interruption have not passed.
void addUnplayed(const std::vector<regression::Scenario>& scenarios, report::TestReport& report) {
    for (const regression::Scenario& scenario : scenarios) {
        const bool isThere =
            std::ranges::any_of(report.scenarios, [&](const auto& s) { return s.name == scenario.name; });
        if (isThere) continue;
        report::TestScenario unplayed;
        unplayed.name = scenario.name;
        unplayed.title = scenario.spec.title;
        unplayed.file = scenario.file.string();
        unplayed.verdict = unplayed.state.verdict = report::Verdict::failed;
        unplayed.state.word = "not begun !";
        unplayed.faults.push_back("interrupted before its start");
        report.scenarios.push_back(std::move(unplayed));
    }
}

int test(const TestFlags& flags) {
    TestRun run = prepare(flags);
    core::prepareFolderOf(pageIn(flags.output));
    if (!flags.junit.empty()) core::prepareFolderOf(flags.junit);
    const std::optional<Shard> piece = flags.shard.empty() ? std::nullopt : std::optional(shard(flags.shard));
    const std::vector<pipeline::RunLock> locks = lockReport(flags.output, run, piece);
    noteMissingLocks(locks);
    if (piece && flags.resume)
        if (const std::optional<TestShard> stored = storedShard(flags.output, run, *piece)) {
            printNote("--shard {} is there already, in {}: {}\n", flags.shard, flags.output,
                      report::testSummary(stored->report));
            return exitCodeOf(*stored);
        }

    const Interruption interruption;
    const core::ThreadLimit limit(run.suite.threadsEach);
    const core::Stopwatch watch;
    report::TestReport report = blankReport(run);
    report.notes = orphans(flags, run);
    for (const std::string& note : report.notes) printWarning(note);
    {
        LiveLine line(flags.quiet);
        const int count = static_cast<int>(run.read.scenarios.size());
        run.suite.scenarioDone = [&](int done, const report::TestScenario& scenario) {
            if (line.isDue(done == count))
                line.show(fmt::format("{} of {}  {}: {}", done, count, scenario.name, nameOf(scenario.verdict)));
        };
        report.scenarios =
            regression::runSuite(run.read.scenarios, run.suite, run.manifest, report.renderer, interruption.flag());
    }
    if (const std::string note = regression::otherRendererNote(report, run.manifest); !note.empty()) {
        report.notes.push_back(note);
        printWarning(note);
    }
    if (flags.calibrate && !interruption.flag())
        report.calibration =
            runCalibration({run.read.scenarios, run.suite.drawing, run.manifest.tolerance, flags.gl, flags.quiet},
                           interruption.flag());
    for (const regression::UnreadScenario& scenario : run.read.unread) {
        report.scenarios.push_back(regression::unreadScenario(scenario));
        printNote("{}\n", scenario.fault);
    }
    report.seconds = watch.seconds();
    addAcceptance(acceptBeginning(flags), report);
    if (interruption.exitCode()) addUnplayed(run.read.scenarios, report);
    showOutcome(report, flags.output);
    if (!piece) writeReport(report, flags.output, flags.junit);
    if (piece && !interruption.exitCode()) {
        writeShard(flags.output,
                   {*piece, run.key, run.names, acceptBeginning(flags), !run.read.unread.empty(), report});
        printResult("\n{}; {}\n", report::testSummary(report), shardPath(flags.output, *piece).string());
    }
    int code = exitCodeOf(report::verdictOf(report));
    if (!run.read.unread.empty()) code = static_cast<int>(ExitCode::badContent);
    return interruption.exitCode() ? static_cast<int>(*interruption.exitCode()) : code;
}

// The outcome of a scenario that cannot become a golden.
void refuseToUpdate(const regression::Scenario& scenario, const regression::Played& played) {
    if (played.divergence) throw core::Error(core::ErrorKind::diverged, played.divergence->message);
    for (const report::TestCheck& check : played.checks)
        if (check.verdict == report::Verdict::failed)
            throw CheckFailed(
                fmt::format("{}: a check fails, so no golden was recorded\n"
                            "{}: {}",
                            scenario.name, check.source, check.reason));
    for (const regression::PlayedPicture& picture : played.pictures)
        if (!picture.fault.empty())
            throw CheckFailed(
                fmt::format("{}: picture {} cannot be drawn: {}", scenario.name, picture.request.key(), picture.fault));
}

int update(const TestFlags& flags) {
    TestRun run = prepare(flags);
    if (!run.read.unread.empty()) throw core::Error(core::ErrorKind::badContent, run.read.unread.front().fault);
    const Interruption interruption;
    const core::ThreadLimit limit(flags.threads);
    regression::Drawer drawer(run.suite.drawing);
    for (const regression::Scenario& scenario : run.read.scenarios) {
        printWarnings(scenario.warnings);
        const regression::Played played = regression::playScenario(
            scenario, drawer, {.threads = flags.threads, .savesStates = true}, interruption.flag());
        if (played.interrupted) return static_cast<int>(*interruption.exitCode());
        refuseToUpdate(scenario, played);
        const std::vector<std::string> changes =
            regression::updateGoldens(scenario, played, run.suite.goldens, run.manifest, flags.why);
        for (const std::string& change : changes) printResult("{}\n", change);
        if (changes.empty()) printResult("{}: nothing differs from its goldens\n", scenario.name);
    }
    return static_cast<int>(ExitCode::ok);
}

Action declareTest(Options& options) {
    const auto flags = std::make_shared<TestFlags>();
    options.value("SCENARIOS", flags->paths, "Scenario files, folders of them, or names of shipped ones").required();
    options.value("-o,--output", flags->output, "Folder for report.html and the pictures of this run").showDefault();
    options.value("--goldens", flags->goldens, "Folder of goldens; default 'golden' in the first folder");
    options.value("--junit", flags->junit, "Also write the results as JUnit XML").typeName("FILE");
    options.value("--filter", flags->filters, "Scenarios of this name, * for any letters; repeatable")
        .typeName("NAME")
        .oneValue();
    options
        .value("--shard", flags->shard,
               "Play this of N shares of the scenarios, 0/N to N-1/N, into a common folder; then taut join")
        .typeName("K/N");
    options.flag("--resume", flags->resume, "With --shard: if that shard exists, only return its exit code");
    options.value("--update", flags->updates, "Record new goldens of this scenario; repeatable, with --why")
        .typeName("NAME")
        .oneValue();
    options.value("--why", flags->why, "Reason for an update, kept in the manifest").typeName("TEXT");
    addRendererFlag(options, flags->gl);
    addThreadsFlag(options, flags->threads);
    options.flag("--calibrate", flags->calibrate,
                 "Measure noise and deliberate errors against the thresholds of pictures");
    options.flag("--require-goldens", flags->requireGoldens,
                 "Report a scenario without goldens as missing, even if it has checks: for CI");
    addConfinedFlag(options, flags->isConfined);
    options.flag("--quiet", flags->quiet, "Print no progress");
    options.footer(
        "Examples:\n"
        "  taut test my --require-goldens --confined             in CI, where others propose scenarios\n"
        "  taut test assets/scenarios --goldens tests/golden --junit out/test/junit.xml\n"
        "  taut test my -o out/test --shard 0/4 --resume         one of four; then taut join out/test\n"
        "  taut test my --update flag --why \"the wind blows from the left now\"\n"
        "Exit codes: 0 passed, 1 a check or golden failed, 3 a scenario cannot be read, 4 a scenario diverged,\n"
        "8 a golden is missing, or was recorded by other bits (results have changed since); checks are evaluated\n"
        "nevertheless. Of several the first of 3, 4, 1, 8.");
    return [flags] { return flags->updates.empty() && flags->why.empty() ? test(*flags) : update(*flags); };
}

}  // namespace

Command testCommand() {
    return {"test", "Compare scenarios with goldens and evaluate their checks", declareTest};
}

}  // namespace taut::game
