// What is made of the report of a run of tests: its exit code, what accepts what differs, the page and the files. It
// plays nothing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "game/test_suite.h"
#include "taut/report/test_report.h"

namespace taut::game {

// The beginning of the command that makes what scenarios do their goldens.
std::string acceptBeginning(const TestFlags& flags);

// Says of each scenario what accepts it, and of all what is outdated.
void addAcceptance(const std::string& beginning, report::TestReport& report);

int exitCodeOf(report::Verdict verdict);

// Prints what came out, and writes the pictures of this run below the folder.
void showOutcome(const report::TestReport& report, const std::filesystem::path& folder);

// The page in the folder and, unless its name is empty, the JUnit file.
void writeReport(const report::TestReport& report, const std::filesystem::path& folder, const std::string& junit);

std::filesystem::path pageIn(const std::filesystem::path& folder);

}  // namespace taut::game
