#include "game/lab.h"
#include "game/exit_code.h"

#include <fmt/format.h>

#include <system_error>

#include "game/messages.h"
#include "game/progress.h"
#include "game/suggestion.h"
#include "game/usage.h"
#include "game/version.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/ode/method_table.h"
#include "taut/report/gnuplot.h"

namespace taut::game {

void checkMethods(const std::vector<std::string>& wanted) {
    std::vector<std::string> names;
    for (const ode::MethodInfo& method : ode::methods()) names.emplace_back(method.name);
    for (const std::string& name : wanted)
        if (ode::findMethod(name) == nullptr) {
            const std::string hint = didYouMean(name, names);
            failUsage("there is no method '{}'{}", name,
                      hint.empty() ? fmt::format("; there are {}", fmt::join(names, ", ")) : hint);
        }
}

std::vector<std::pair<std::string, std::string>> machineFacts(const pipeline::Machine& machine) {
    return {{"processor", machine.processor}, {"compiler", machine.compiler}, {"flags", TAUT_FLAGS},
            {"simd", machine.simd},           {"program", machine.program},   {"commit", commitText()},
            {"system", machine.system}};
}

std::string programText(const pipeline::Machine& machine) {
    return fmt::format("{}, commit {}", machine.program, commitText());
}

void LabProgress::show(double done, const std::string& doing) {
    if (stop_ || !line_.isDue(done >= 1.0)) return;
    const double spent = watch_.seconds();
    const std::string left = done > 0.01 ? clockText(spent * (1.0 / done - 1.0)) + " left" : "time left unknown";
    line_.show(fmt::format("{} {:3.0f} %  {}  {}", name_, 100 * done, left, doing));
}

LabFolder::LabFolder(std::filesystem::path folder, bool isQuiet)
    : folder_(std::move(folder)), draws_(!report::gnuplotVersion().empty()), isQuiet_(isQuiet) {
    std::error_code ignored;  // an unreadable folder is reported when it is made
    const std::string ending = folder_.extension().string();
    for (const char* ofOne : {".csv", ".json", ".svg", ".png", ".html"})
        if (ending == ofOne && !std::filesystem::is_directory(folder_, ignored))
            failUsage("-o {}: the results are several files: -o {} names a folder", folder_.string(),
                      std::filesystem::path(folder_).replace_extension().string());
    for (std::filesystem::path at = folder_; !at.empty() && !std::filesystem::exists(at, ignored);
         at = at.parent_path())
        made_.push_back(at);
    core::prepareFolderOf(folder_ / "any");
    if (!draws_) printWarning(report::gnuplotMissing() + "; only CSV and JSON will be written");
}

void LabFolder::write(const std::string& name, const std::string& text) const {
    core::writeWholeFile(folder_ / name, text);
}

void LabFolder::draw(const std::string& name, const report::Chart& chart) const {
    if (draws_) report::writeChart(chart, folder_ / name);
}

int LabFolder::finish(const Interruption& interruption) const {
    const auto code = interruption.exitCode();
    if (code)
        printNote("interrupted: the results so far are in {}\n", folder_.string());
    else if (!isQuiet_)
        printNote("in {}\n", folder_.string());
    if (!draws_) throw core::Error(core::ErrorKind::inputOutput, "no pictures: " + report::gnuplotMissing());
    return static_cast<int>(code.value_or(ExitCode::ok));
}

int LabFolder::abandon(const Interruption& interruption) const {
    std::error_code ignored;  // a folder with something in it stays
    for (const std::filesystem::path& folder : made_) std::filesystem::remove(folder, ignored);
    printNote("interrupted: nothing is written\n");
    return static_cast<int>(interruption.exitCode().value_or(ExitCode::interrupted));
}

}  // namespace taut::game
