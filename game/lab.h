// The common part of the measuring commands: checked flags, progress, the folder of results, facts of the machine.
// Independent of the measurements.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "game/interruption.h"
#include "game/live_line.h"
#include "taut/core/private/stopwatch.h"
#include "taut/pipeline/machine.h"
#include "taut/report/chart.h"

namespace taut::game {

// Throws core::Error(usage), with a suggestion, for the name of no method.
void checkMethods(const std::vector<std::string>& wanted);

// Name and value of everything on which measured times depend.
std::vector<std::pair<std::string, std::string>> machineFacts(const pipeline::Machine& machine);
std::string programText(const pipeline::Machine& machine);  // version and commit

// Reports progress and the remaining time. Any thread may call it, one at a time. It stays silent once stopped, because
// work after that is no measure.
class LabProgress {
  public:
    LabProgress(std::string name, bool isQuiet, const std::atomic<bool>& stop)
        : name_(std::move(name)), line_(isQuiet), stop_(stop) {}
    void show(double done, const std::string& doing);

  private:
    std::string name_;
    LiveLine line_;
    const std::atomic<bool>& stop_;
    core::Stopwatch watch_;
};

// Runs a study with these settings, with progress and until an interruption.
template <class Settings, class Study>
auto followed(const std::string& name, bool isQuiet, const Interruption& interruption, Settings settings,
              const Study& study) {
    LabProgress line(name, isQuiet, interruption.flag());
    settings.listener = {&interruption.flag(),
                         [&line](double done, const std::string& doing) { line.show(done, doing); }};
    return study(settings);
}

// The folder for results. Without gnuplot it holds tables only, and says so.
class LabFolder {
  public:
    // Makes the folder; throws core::Error: inputOutput, and usage for the name of one picture or table.
    LabFolder(std::filesystem::path folder, bool isQuiet);
    void write(const std::string& name, const std::string& text) const;
    void draw(const std::string& name, const report::Chart& chart) const;

    // Says where the results are and returns the exit code; throws core::Error(inputOutput) without gnuplot.
    int finish(const Interruption& interruption) const;
    // The same after an interruption before there were results: removes the folders that it made.
    int abandon(const Interruption& interruption) const;

  private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> made_;  // new folders, the innermost first
    bool draws_, isQuiet_;
};

}  // namespace taut::game
