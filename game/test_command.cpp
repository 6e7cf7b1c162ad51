#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "game/calibration_run.h"
#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/folders.h"
#include "game/interruption.h"
#include "game/live_line.h"
#include "game/messages.h"
#include "game/renderers.h"
#include "game/scene_file.h"
#include "game/shell_word.h"
#include "game/suggestion.h"
#include "taut/core/error.h"
#include "taut/core/file_batch.h"
#include "taut/core/glob.h"
#include "taut/core/parallel.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/machine.h"
#include "taut/pipeline/run_lock.h"
#include "taut/regression/goldens.h"
#include "taut/regression/judging.h"
#include "taut/regression/suite.h"
#include "taut/report/junit.h"
#include "taut/report/test_page.h"
#include "taut/world/result_bits.h"

namespace taut::game {
namespace {

struct TestFlags {
    std::vector<std::string> paths, filters, updates;
    std::string output = "out/test", goldens, junit, why, gl, isa;
    int threads = 0;
    bool quiet = false, calibrate = false, requireGoldens = false, isConfined = false;
};

using Clock = std::chrono::steady_clock;

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

std::vector<std::string> namesOf(const regression::ReadScenarios& read) {
    std::vector<std::string> names;
    for (const regression::Scenario& scenario : read.scenarios) names.push_back(scenario.name);
    for (const regression::UnreadScenario& scenario : read.unread) names.push_back(scenario.name);
    return names;
}

// Keeps what --filter or --update names; throws core::Error(usage) for a name that fits nothing.
void choose(const TestFlags& flags, regression::ReadScenarios& read) {
    const bool updates = !flags.updates.empty();
    const std::vector<std::string>& wanted = updates ? flags.updates : flags.filters;
    if (wanted.empty()) return;
    const auto fits = [&](const std::string& word, const std::string& name) {
        return updates ? word == name : core::matches(word, name);
    };
    const std::vector<std::string> names = namesOf(read);
    for (const std::string& word : wanted)
        if (std::none_of(names.begin(), names.end(), [&](const std::string& name) { return fits(word, name); })) {
            const std::string hint = didYouMean(word, names);
            throw core::Error(
                core::ErrorKind::usage,
                fmt::format("{}: there is no scenario '{}'{}", updates ? "--update" : "--filter", word,
                            hint.empty() ? "; there are " + fmt::format("{}", fmt::join(names, ", ")) : hint));
        }
    const auto isUnwanted = [&](const auto& scenario) {
        return std::none_of(wanted.begin(), wanted.end(),
                            [&](const std::string& word) { return fits(word, scenario.name); });
    };
    std::erase_if(read.scenarios, isUnwanted);
    std::erase_if(read.unread, isUnwanted);
}

void checkFlags(const TestFlags& flags) {
    const auto fail = [](const char* message) { throw core::Error(core::ErrorKind::usage, message); };
    const bool hasWhy = flags.why.find_first_not_of(" \t\r\n") != std::string::npos;
    if (!flags.updates.empty() && !hasWhy)
        fail("--update changes what counts as right: say why with --why \"…\"; the manifest keeps it");
    if (flags.updates.empty() && !flags.why.empty()) fail("--why goes with --update NAME");
    if (!flags.updates.empty() && !flags.filters.empty())
        fail("--update names the scenarios itself: leave --filter out");
    if (!flags.updates.empty() && flags.calibrate) fail("--calibrate changes no golden: leave --update out");
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

struct Run {
    std::vector<std::filesystem::path> paths;
    regression::ReadScenarios read;
    regression::SuiteOptions suite;
    regression::Manifest manifest;
    pipeline::RunLock lock;  // of the goldens, while they are changed
};

// What a scenario is held against lies in its folder, and nothing there leads elsewhere.
void refuseLinks(const std::filesystem::path& goldens) {
    std::error_code none;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(goldens, none))
        if (entry.is_symlink())
            throw core::Error(
                core::ErrorKind::badContent,
                fmt::format("{} is a link; goldens of confined scenarios hold none", entry.path().string()));
}

Run prepare(const TestFlags& flags) {
    checkFlags(flags);
    Run run;
    for (const std::string& path : flags.paths) run.paths.push_back(scenarioPath(path));
    run.read = regression::readScenarios(regression::scenarioFiles(run.paths), loadOptions({}, flags.isConfined));
    choose(flags, run.read);
    run.suite.requiresGoldens = flags.requireGoldens;
    run.suite.goldens = goldenFolder(flags, run.paths);
    if (flags.isConfined) refuseLinks(run.suite.goldens.path);
    if (!flags.updates.empty()) {
        const std::string name = fmt::format("taut test --update {}, process {}", flags.updates.front(), ::getpid());
        run.lock = pipeline::RunLock(run.suite.goldens.path, {std::nullopt, name});
        core::FileBatch::recover(run.suite.goldens.path);
    }
    run.manifest = regression::readManifest(run.suite.goldens);

    const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    const int threads = flags.threads > 0 ? flags.threads : machine;
    run.suite.sideBySide = std::clamp(static_cast<int>(run.read.scenarios.size()), 1, threads);
    run.suite.threadsEach = std::max(1, threads / run.suite.sideBySide);
    run.suite.drawing = drawingOptions(flags, run.suite.threadsEach);
    return run;
}

// The command that makes what scenarios do their goldens.
std::string acceptCommand(const TestFlags& flags, const std::vector<std::string>& names) {
    std::string command = "taut test";
    for (const std::string& path : flags.paths) command += " " + shellWord(path);
    if (!flags.goldens.empty()) command += " --goldens " + shellWord(flags.goldens);
    if (!flags.gl.empty()) command += " --gl " + flags.gl;
    for (const std::string& name : names) command += " --update " + shellWord(name);
    return command + " --why \"…\"";
}

// Whether something of it differs from its goldens.
bool isAcceptable(const report::TestScenario& scenario) {
    const auto differs = [](const auto& item) {
        return item.verdict == report::Verdict::failed || item.verdict == report::Verdict::missing;
    };
    if (scenario.state.verdict == report::Verdict::outdated) return scenario.state.bits < world::resultBits;
    if (!scenario.state.word.empty()) return false;  // there is nothing to accept
    return differs(scenario.state) || std::any_of(scenario.pictures.begin(), scenario.pictures.end(), differs);
}

// A line for each number of bits that goldens were recorded by.
std::vector<std::string> outdatedLines(const TestFlags& flags, const std::vector<report::TestScenario>& scenarios) {
    std::map<int, std::vector<std::string>> names;
    for (const report::TestScenario& scenario : scenarios)
        if (scenario.state.verdict == report::Verdict::outdated) names[scenario.state.bits].push_back(scenario.name);
    std::vector<std::string> lines;
    for (const auto& [bits, all] : names)
        lines.push_back(world::recordedBy(bits) + ": " +
                        (bits < world::resultBits ? acceptCommand(flags, all)
                                                  : fmt::format("{} need{} a newer taut", fmt::join(all, ", "),
                                                                all.size() == 1 ? "s" : "")));
    return lines;
}

void writePictures(const std::filesystem::path& folder, const report::TestScenario& scenario) {
    const auto write = [&](const std::string& name, const std::vector<std::byte>& bytes) {
        if (bytes.empty()) return;
        const std::filesystem::path path = folder / scenario.name / name;
        core::prepareFolderOf(path);
        core::WholeFile file(path);
        file.write(std::span<const std::byte>(bytes));
        file.commit();
    };
    for (const report::TestPicture& picture : scenario.pictures) {
        write(picture.key + ".png", picture.actual);
        if (picture.verdict == report::Verdict::failed) write(picture.key + "-difference.png", picture.difference);
    }
}

int exitCodeOf(report::Verdict verdict) {
    switch (verdict) {
        case report::Verdict::diverged: return static_cast<int>(ExitCode::diverged);
        case report::Verdict::failed: return static_cast<int>(ExitCode::checkFailed);
        case report::Verdict::missing:
        case report::Verdict::outdated: return static_cast<int>(ExitCode::goldenMissing);
        case report::Verdict::passed:
        case report::Verdict::skipped: break;
    }
    return static_cast<int>(ExitCode::ok);
}

report::TestReport blankReport(const Run& run) {
    const pipeline::Machine machine = pipeline::machine();
    report::TestReport report;
    report.program = machine.program;
    report.compiler = machine.compiler;
    report.machine = fmt::format("{}, {}", machine.processor, machine.simd);
    report.tolerance = fmt::format("A picture is right when {}. A state is right to the last bit.",
                                   regression::inWords(run.manifest.tolerance));
    return report;
}

// Goldens of scenarios that are gone; said when all of the folders' scenarios were looked for.
std::vector<std::string> orphans(const TestFlags& flags, const Run& run) {
    std::vector<std::string> notes;
    std::error_code ignored;
    for (const std::filesystem::path& path : run.paths)
        if (!flags.filters.empty() || !std::filesystem::is_directory(path, ignored)) return notes;
    const std::vector<std::string> names = namesOf(run.read);
    for (const auto& [name, goldens] : run.manifest.scenarios)
        if (std::find(names.begin(), names.end(), name) == names.end())
            notes.push_back(fmt::format("{}: there are goldens of '{}', and no such scenario",
                                        run.suite.goldens.manifest().string(), name));
    return notes;
}

int finish(const TestFlags& flags, const report::TestReport& report, const std::filesystem::path& page) {
    // First what a full disk cannot take away.
    printResult("{}{}{}", report::testTable(report), report::testFailures(report), report::calibrationTable(report));
    for (const report::TestScenario& scenario : report.scenarios) writePictures(flags.output, scenario);
    core::writeWholeFile(page, report::testPage(report));
    if (!flags.junit.empty()) core::writeWholeFile(flags.junit, report::junitXml(report));
    printResult("\n{}; {}\n", report::testSummary(report), page.string());
    return exitCodeOf(report::verdictOf(report));
}

// What had not ended when the run was interrupted has not passed.
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
    Run run = prepare(flags);
    const std::filesystem::path page = std::filesystem::path(flags.output) / "report.html";
    core::prepareFolderOf(page);
    if (!flags.junit.empty()) core::prepareFolderOf(flags.junit);

    const Interruption interruption;
    const core::ThreadLimit limit(run.suite.threadsEach);
    const auto start = Clock::now();
    report::TestReport report = blankReport(run);
    report.notes = orphans(flags, run);
    printWarnings(report.notes);
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
        printWarnings({note});
    }
    if (flags.calibrate && !interruption.flag())
        report.calibration =
            runCalibration({run.read.scenarios, run.suite.drawing, run.manifest.tolerance, flags.gl, flags.quiet},
                           interruption.flag());
    for (const regression::UnreadScenario& scenario : run.read.unread) {
        report.scenarios.push_back(regression::unreadScenario(scenario));
        printNote("{}\n", scenario.fault);
    }
    report.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    for (report::TestScenario& scenario : report.scenarios)
        if (isAcceptable(scenario)) scenario.accept = acceptCommand(flags, {scenario.name});
    report.outdated = outdatedLines(flags, report.scenarios);
    if (interruption.exitCode()) addUnplayed(run.read.scenarios, report);
    int code = finish(flags, report, page);
    if (!run.read.unread.empty()) code = static_cast<int>(ExitCode::badContent);
    return interruption.exitCode() ? static_cast<int>(*interruption.exitCode()) : code;
}

// What became of a scenario that cannot be made a golden.
void refuseToUpdate(const regression::Scenario& scenario, const regression::Played& played) {
    if (played.divergence) throw core::Error(core::ErrorKind::diverged, played.divergence->message);
    for (const report::TestCheck& check : played.checks)
        if (check.verdict == report::Verdict::failed)
            throw CheckFailed(fmt::format("{}: a check fails, so nothing of it becomes golden\n{}: {}", scenario.name,
                                          check.source, check.reason));
    for (const regression::PlayedPicture& picture : played.pictures)
        if (!picture.fault.empty())
            throw CheckFailed(
                fmt::format("{}: picture {} cannot be drawn: {}", scenario.name, picture.request.key(), picture.fault));
}

int update(const TestFlags& flags) {
    Run run = prepare(flags);
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
    options.value("-o,--output", flags->output, "The folder for report.html and the pictures of this run")
        .showDefault();
    options.value("--goldens", flags->goldens, "The folder of goldens; the first folder's 'golden' when left out");
    options.value("--junit", flags->junit, "Write the results as JUnit XML too").typeName("FILE");
    options.value("--filter", flags->filters, "Only scenarios of this name, * for any letters; repeatable")
        .typeName("NAME")
        .oneValue();
    options.value("--update", flags->updates, "Make what this scenario does its golden; repeatable, with --why")
        .typeName("NAME")
        .oneValue();
    options.value("--why", flags->why, "The reason for an update, kept in the manifest").typeName("TEXT");
    addRendererFlag(options, flags->gl);
    options.value("--threads", flags->threads, "Threads to use; all of the machine when not given").within(1, 1024);
    addInstructionSetFlag(options, flags->isa);
    options.flag("--calibrate", flags->calibrate,
                 "Measure what the thresholds of pictures let through: noise, and mistakes made on purpose");
    options.flag("--require-goldens", flags->requireGoldens,
                 "A scenario with checks alone, never recorded, is a missing golden: for CI");
    addConfinedFlag(options, flags->isConfined);
    options.flag("--quiet", flags->quiet, "No progress");
    options.footer(
        "Examples:\n"
        "  taut test my --require-goldens --confined             in CI, where others propose scenarios\n"
        "  taut test assets/scenarios --goldens tests/golden --junit out/test/junit.xml\n"
        "  taut test my --update flag --why \"the wind blows from the left now\"\n"
        "Exit codes: 0 all right, 1 a check or golden failed, 3 a scenario cannot be read, 4 a scenario diverged,\n"
        "8 a golden is missing, or was recorded by other bits (results have changed since); checks are judged all the\n"
        "same. Of several the first of 3, 4, 1, 8.");
    return [flags] { return flags->updates.empty() && flags->why.empty() ? test(*flags) : update(*flags); };
}

}  // namespace

Command testCommand() {
    return {"test", "Play scenarios and compare their states and pictures with goldens", declareTest};
}

}  // namespace taut::game
