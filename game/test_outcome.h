// The consequences of the report of a test run: exit code, commands that accept differences, the page and the files. It
// plays nothing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "game/test_suite.h"
#include "taut/report/test_report.h"

namespace taut::game {

// The beginning of the command that records the results of scenarios as their goldens.
std::string acceptBeginning(const TestFlags& flags);

// Adds to each scenario the command that accepts it, and to the report the outdated scenarios.
void addAcceptance(const std::string& beginning, report::TestReport& report);

int exitCodeOf(report::Verdict verdict);

// Prints the outcome, and writes the pictures of this run below the folder.
void showOutcome(const report::TestReport& report, const std::filesystem::path& folder);

// Writes the page into the folder and, unless its name is empty, the JUnit file.
void writeReport(const report::TestReport& report, const std::filesystem::path& folder, const std::string& junit);

std::filesystem::path pageIn(const std::filesystem::path& folder);

}  // namespace taut::game
