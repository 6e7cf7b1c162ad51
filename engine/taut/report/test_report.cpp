#include "taut/report/test_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "taut/core/private/utf8.h"
#include "taut/report/table.h"

namespace taut::report {
namespace {

template <class Items>
std::string countPassed(const Items& items) {
    if (std::all_of(items.begin(), items.end(), [](const auto& item) { return item.verdict == Verdict::outdated; }))
        return "-";  // or there are none
    const auto passed =
        std::count_if(items.begin(), items.end(), [](const auto& item) { return item.verdict == Verdict::passed; });
    return fmt::format("{}/{}{}", passed, items.size(), static_cast<std::size_t>(passed) == items.size() ? "" : " !");
}

std::string stateWord(const TestScenario& scenario) {
    const Verdict verdict = scenario.state.verdict;
    if (!scenario.state.word.empty()) return scenario.state.word;
    if (verdict == Verdict::passed) return fmt::format("same, {} ticks", scenario.state.ticks);
    if (verdict == Verdict::skipped) return "-";
    return (verdict == Verdict::failed ? "differs" : nameOf(verdict)) + " !";
}

void addLine(std::string& text, const std::string& line) {
    text += "  ";
    for (const char c : line) {
        text += c;
        if (c == '\n') text += "    ";
    }
    text += '\n';
}

}  // namespace

std::string nameOf(Verdict verdict) {
    constexpr std::array names{"passed", "skipped", "outdated", "missing", "failed", "diverged"};
    return names[static_cast<std::size_t>(verdict)];
}

std::string acceptHeading(const TestScenario& scenario) {
    const bool fails = std::any_of(scenario.checks.begin(), scenario.checks.end(),
                                   [](const TestCheck& check) { return check.verdict == Verdict::failed; });
    return fails ? "Where this is meant, once its checks hold" : "Where this is meant";
}

Verdict verdictOf(const TestReport& report) {
    Verdict verdict = Verdict::passed;
    for (const TestScenario& scenario : report.scenarios) verdict = std::max(verdict, scenario.verdict);
    for (const CalibrationRow& row : report.calibration)
        if (!row.refusal.empty()) verdict = std::max(verdict, Verdict::failed);
    return verdict;
}

std::string testTable(const TestReport& report) {
    TextTable table{{"scenario", "", "checks", "state", "pictures", "time"}, {}};
    for (const TestScenario& scenario : report.scenarios)
        table.rows.push_back({scenario.name, nameOf(scenario.verdict), countPassed(scenario.checks),
                              stateWord(scenario), countPassed(scenario.pictures),
                              fmt::format("{:5.1f} s", scenario.seconds)});
    return aligned(table);
}

std::string testFailures(const TestReport& report) {
    std::string text;
    for (const TestScenario& scenario : report.scenarios) {
        const bool isSilent = scenario.verdict == Verdict::passed || scenario.verdict == Verdict::outdated;
        if (isSilent && scenario.notes.empty()) continue;
        text += fmt::format("\n{} ({})\n", core::printable(scenario.name, true), core::printable(scenario.file, true));
        for (const std::string& fault : scenario.faults) addLine(text, fault);
        for (const TestCheck& check : scenario.checks)
            if (!check.reason.empty()) addLine(text, fmt::format("{}: {}", check.source, check.reason));
        if (!scenario.state.reason.empty() && scenario.state.verdict != Verdict::outdated)
            addLine(text, fmt::format("state: {}", scenario.state.reason));
        for (const TestPicture& picture : scenario.pictures)
            if (!picture.reason.empty()) addLine(text, fmt::format("picture {}: {}", picture.key, picture.reason));
        for (const std::string& note : scenario.notes) addLine(text, fmt::format("note: {}", note));
        if (!scenario.accept.empty() && scenario.verdict != Verdict::outdated)
            addLine(text, fmt::format("{}: {}", acceptHeading(scenario), scenario.accept));
    }
    for (const std::string& line : report.outdated) text += fmt::format("\n{}\n", line);
    return text;
}

std::string testSummary(const TestReport& report) {
    std::string text = fmt::format("{} scenario{}:", report.scenarios.size(), report.scenarios.size() == 1 ? "" : "s");
    const char* comma = " ";
    for (const Verdict verdict :
         {Verdict::diverged, Verdict::failed, Verdict::missing, Verdict::outdated, Verdict::skipped, Verdict::passed}) {
        const auto count = std::count_if(report.scenarios.begin(), report.scenarios.end(),
                                         [&](const TestScenario& scenario) { return scenario.verdict == verdict; });
        if (count == 0) continue;
        text += fmt::format("{}{} {}", comma, count, verdict == Verdict::missing ? "without golden" : nameOf(verdict));
        comma = ", ";
    }
    return text + fmt::format(", {:.1f} s", report.seconds);
}

std::string calibrationTable(const TestReport& report) {
    if (report.calibration.empty()) return "";
    TextTable table{{"scenario", "picture", "against", "pixels", "worst tile", "mean", "largest", "picture", "state",
                     "meant for", ""},
                    {}};
    for (const CalibrationRow& row : report.calibration) {
        const auto word = [&](bool has, bool differs) { return !has ? "-" : differs ? "differs" : "same"; };
        table.rows.push_back({row.scenario, row.picture, row.what,
                              row.hasPicture ? fmt::format("{:.4f} %", 100.0 * row.share) : "-",
                              row.hasPicture ? fmt::format("{:.1f} %", 100.0 * row.tileShare) : "-",
                              row.hasPicture ? fmt::format("{:.4f}", row.offset) : "-",
                              row.hasPicture ? fmt::format("{}", row.largest) : "-",
                              word(row.hasPicture, row.pictureDiffers), word(row.hasState, row.stateDiffers),
                              row.isMutant ? row.meantFor : "noise", row.refusal.empty() ? "" : "REFUSED"});
    }
    std::string text = aligned(table);
    for (const CalibrationRow& row : report.calibration)
        if (!row.refusal.empty())
            text += fmt::format("{} {}, {}: {}\n", row.scenario, row.picture, row.what, row.refusal);
    return text;
}

}  // namespace taut::report
