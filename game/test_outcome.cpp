#include "game/test_outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "game/exit_code.h"
#include "game/messages.h"
#include "game/shell_word.h"
#include "taut/core/whole_file.h"
#include "taut/report/junit.h"
#include "taut/report/test_page.h"
#include "taut/world/result_bits.h"

namespace taut::game {
namespace {

// The command that records the results of scenarios as their goldens.
std::string acceptCommand(const std::string& beginning, const std::vector<std::string>& names) {
    std::string command = beginning;
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
    return differs(scenario.state) || std::ranges::any_of(scenario.pictures, differs);
}

// A line for each number of bits that goldens were recorded by.
std::vector<std::string> outdatedLines(const std::string& beginning,
                                       const std::vector<report::TestScenario>& scenarios) {
    std::map<int, std::vector<std::string>> names;
    for (const report::TestScenario& scenario : scenarios)
        if (scenario.state.verdict == report::Verdict::outdated) names[scenario.state.bits].push_back(scenario.name);
    std::vector<std::string> lines;
    for (const auto& [bits, all] : names)
        lines.push_back(world::recordedBy(bits) + ": " +
                        (bits < world::resultBits ? acceptCommand(beginning, all)
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

}  // namespace

std::string acceptBeginning(const TestFlags& flags) {
    std::string command = "taut test";
    for (const std::string& path : flags.paths) command += " " + shellWord(path);
    if (!flags.goldens.empty()) command += " --goldens " + shellWord(flags.goldens);
    if (!flags.gl.empty()) command += " --gl " + flags.gl;
    return command;
}

void addAcceptance(const std::string& beginning, report::TestReport& report) {
    for (report::TestScenario& scenario : report.scenarios)
        if (isAcceptable(scenario)) scenario.accept = acceptCommand(beginning, {scenario.name});
    report.outdated = outdatedLines(beginning, report.scenarios);
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

void showOutcome(const report::TestReport& report, const std::filesystem::path& folder) {
    // First the output that a full disk cannot prevent.
    printResult("{}{}{}", report::testTable(report), report::testFailures(report), report::calibrationTable(report));
    for (const report::TestScenario& scenario : report.scenarios) writePictures(folder, scenario);
}

void writeReport(const report::TestReport& report, const std::filesystem::path& folder, const std::string& junit) {
    const std::filesystem::path page = pageIn(folder);
    core::writeWholeFile(page, report::testPage(report));
    if (!junit.empty()) core::writeWholeFile(junit, report::junitXml(report));
    printResult("\n{}; {}\n", report::testSummary(report), page.string());
}

std::filesystem::path pageIn(const std::filesystem::path& folder) {
    return folder / "report.html";
}

}  // namespace taut::game
