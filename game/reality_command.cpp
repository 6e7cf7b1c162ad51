#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/interruption.h"
#include "game/lab.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "game/usage.h"
#include "taut/core/private/contains.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/machine.h"
#include "taut/reality/chart.h"
#include "taut/reality/comparison.h"
#include "taut/reality/text.h"

namespace taut::game {
namespace {

struct RealityFlags {
    std::string output = "out/reality";
    std::vector<std::string> rows;
    std::string beside;
    int cells = 0;
    bool isLong = false, list = false, quiet = false;
};

void printRows() {
    for (const reality::Row& row : reality::rows())
        printResult("{:<4} {}{}\n", row.name, row.title, row.isLong ? " (with --long)" : "");
}

void checkRows(const std::vector<std::string>& wanted) {
    std::vector<std::string> names;
    for (const reality::Row& row : reality::rows()) names.push_back(row.name);
    for (const std::string& name : wanted)
        if (!core::contains(names, name)) failUsage("there is no row '{}'; there are {}", name, fmt::join(names, ", "));
}

int compareWithReality(const RealityFlags& flags) {
    if (flags.list) {
        printRows();
        return static_cast<int>(ExitCode::ok);
    }
    checkRows(flags.rows);
    const std::vector<reality::PeerDroop> peers =
        flags.beside.empty() ? std::vector<reality::PeerDroop>{}
                             : reality::readPeers(core::fileContent(flags.beside), flags.beside);
    const Interruption interruption;
    const LabFolder output(flags.output, flags.quiet);
    reality::Comparison comparison = followed("reality", flags.quiet, interruption,
                                              reality::Settings{.rows = flags.rows,
                                                                .isLong = flags.isLong,
                                                                .cells = flags.cells,
                                                                .assetFolders = loadOptions().assetFolders},
                                              reality::compare);
    if (comparison.isInterrupted && comparison.lines.empty()) return output.abandon(interruption);
    comparison.peers = peers;
    const pipeline::Machine machine = pipeline::machine();
    const std::string note =
        fmt::format("{}, {}, {}; {}", machine.processor, machine.compiler, machine.simd, programText(machine));
    const std::filesystem::path folder = flags.output;
    core::prepareFolderOf(folder / "scenes/any");
    for (const auto& [name, text] : comparison.scenes) output.write("scenes/" + name + ".toml", text);
    output.write("reality.csv", reality::csv(comparison));
    printResult("{}", reality::summary(comparison));
    std::vector<std::string> charts;
    const auto draw = [&](const std::string& name, const std::string& csv, const report::Chart& chart) {
        output.write(name + ".csv", csv);
        output.draw(name, chart);
        const std::filesystem::path svg = folder / (name + ".svg");
        if (std::filesystem::exists(svg)) charts.push_back(core::fileContent(svg));
    };
    if (!comparison.droops.empty())
        draw("cantilever", reality::droopsCsv(comparison),
             reality::droopChart(comparison.droops, comparison.peers, {note}));
    if (!comparison.drapes.empty())
        draw("drape", reality::drapesCsv(comparison), reality::drapeChart(comparison.drapes, {note}));
    output.write("reality.html", reality::page(comparison, charts, note));
    const int code = output.finish(interruption);
    return code == 0 && !comparison.passes() ? static_cast<int>(ExitCode::checkFailed) : code;
}

Action declareReality(Options& options) {
    const auto flags = std::make_shared<RealityFlags>();
    options.value("-o,--output", flags->output, "Folder for the page, the chart, CSV and the scenes")
        .typeName("FOLDER");
    options.value("--only", flags->rows, "Rows to play, separated by commas")
        .separatedBy(',')
        .oneValue()
        .typeName("R1,R4");
    options.flag("--long", flags->isLong, "Add the rows that take minutes");
    options.value("--cells", flags->cells, "Number of cells along the length, instead of each row's own")
        .within(3, 1000);
    options.value("--beside", flags->beside, "Add cantilevers of other programs, as measured").typeName("PEERS.csv");
    options.flag("--list", flags->list, "List the rows");
    options.flag("--quiet", flags->quiet, "Print no progress");
    options.footer(
        "The exit code is 1 if a quantity exceeds its tolerance.\n"
        "Examples:\n"
        "  taut reality\n"
        "  taut reality --only R1,R8 -o out/strips\n"
        "  taut reality --only R1 --cells 5\n"
        "  taut reality --only R1 --beside assets/charts/peers.csv");
    return withThreads(options, [flags] { return compareWithReality(*flags); });
}

}  // namespace

Command realityCommand() {
    return {"reality", "Compare the engine with theory and measurement", declareReality};
}

}  // namespace taut::game
