#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "game/chart_studies.h"
#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/folders.h"
#include "game/interruption.h"
#include "game/lab.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "game/suggestion.h"
#include "game/usage.h"
#include "taut/core/private/contains.h"
#include "taut/ode/method_table.h"
#include "taut/pipeline/machine.h"
#include "taut/study/problems.h"
#include "taut/study/scene_subject.h"
#include "taut/study/steps_table.h"
#include "taut/study/work_precision.h"
#include "taut/study/work_precision_chart.h"
#include "taut/study/work_precision_text.h"

namespace taut::game {
namespace {

struct ChartFlags {
    std::string subject;
    std::string output;
    std::vector<std::string> methods;
    std::string precision = "both";
    double seconds = 0.0, budget = 40.0;
    std::vector<std::string> overrides;
    bool list = false, quiet = false;
};

void printProblems() {
    printResult("taut chart PROBLEM or taut chart SCENE draws error against cost for every method. The problems:\n\n");
    for (const study::ProblemInfo& problem : study::problems())
        printResult("  {:<14} {}\n", problem.name, problem.about);
    for (const ChartStudy& study : chartStudies())
        printResult("\ntaut chart {} draws {} instead: {}\n", study.name, study.draws, study.about);
    printResult("\nThe methods:");
    for (const ode::MethodInfo& method : ode::methods()) printResult(" {}", method.name);
    printResult("\nA SCENE is a file, or the name of a shipped one: {}\n", fmt::join(shippedScenes(), ", "));
}

// A problem by name, or a scene.
std::unique_ptr<study::Subject> chosenSubject(const ChartFlags& flags) {
    if (const study::ProblemInfo* problem = study::findProblem(flags.subject)) {
        if (!flags.overrides.empty())
            failUsage("--set changes fields of scenes; {} is a built-in problem", flags.subject);
        return problem->make();
    }
    std::vector<std::string> names = shippedScenes();
    const bool isBare = flags.subject.find('/') == std::string::npos && !flags.subject.ends_with(".toml") &&
                        !core::contains(names, flags.subject) && !std::filesystem::exists(flags.subject);
    if (isBare) {
        for (const study::ProblemInfo& problem : study::problems()) names.emplace_back(problem.name);
        for (const ChartStudy& own : chartStudies()) names.emplace_back(own.name);
        const std::string hint = didYouMean(flags.subject, names);
        failUsage("there is no problem or scene '{}'{}", flags.subject,
                  hint.empty() ? "; taut chart --list names the problems" : hint);
    }
    const std::filesystem::path file = sceneFile(flags.subject);
    return study::makeSceneSubject(readScene(flags.subject, flags.overrides), file.stem().string());
}

study::StudySettings studySettings(const ChartFlags& flags) {
    study::StudySettings settings;
    settings.methods = flags.methods;
    settings.seconds = flags.seconds;
    settings.budget = flags.budget;
    if (flags.precision == "single") settings.precisions = {study::Precision::single_};
    if (flags.precision == "double") settings.precisions = {study::Precision::double_};
    return settings;
}

// Its two equations have a table of their own.
bool isOfTheSlides(const study::Subject& subject) {
    return subject.name() == "growth" || subject.name() == "quotient";
}

void printResults(const study::WorkPrecision& result, const std::vector<study::StepsRow>& steps) {
    printResult("{}\n\n{}", result.title, study::workPrecisionSummary(result));
    if (!steps.empty())
        printResult(
            "\n"
            "Steps for an error below 1e-6 at the end, and the effect of four evaluations\n\n"
            "{}",
            study::stepsSummary(steps));
    for (const std::string& remark : result.remarks) printResult("\n{}\n", remark);
}

std::string machineNote(const pipeline::Machine& machine) {
    return fmt::format("{}, {}, {}; {}", machine.processor, machine.compiler, machine.simd, programText(machine));
}

int chartStudy(const ChartStudy& study, const ChartFlags& flags) {
    const ChartFlags unset;
    if (!flags.methods.empty() || !flags.overrides.empty() || flags.precision != unset.precision ||
        flags.seconds != unset.seconds || flags.budget != unset.budget)
        failUsage("{} compares {}: it takes --output and --quiet only", study.name, study.compares);
    const std::filesystem::path folder =
        flags.output.empty() ? std::filesystem::path("out/charts") / study.name : std::filesystem::path(flags.output);
    return study.chart(folder, machineNote(pipeline::machine()), flags.quiet);
}

int chart(const ChartFlags& flags) {
    if (flags.list || flags.subject.empty()) {
        printProblems();
        return static_cast<int>(ExitCode::ok);
    }
    checkMethods(flags.methods);
    for (const ChartStudy& study : chartStudies())
        if (flags.subject == study.name) return chartStudy(study, flags);
    const std::unique_ptr<study::Subject> subject = chosenSubject(flags);
    const std::filesystem::path folder = flags.output.empty() ? std::filesystem::path("out/charts") / subject->name()
                                                              : std::filesystem::path(flags.output);
    const Interruption interruption;
    const LabFolder output(folder, flags.quiet);
    const study::WorkPrecision result =
        followed(subject->name(), flags.quiet, interruption, studySettings(flags),
                 [&](const study::StudySettings& settings) { return studyWorkPrecision(*subject, settings); });
    std::vector<study::StepsRow> steps;
    if (isOfTheSlides(*subject) && !result.isInterrupted) steps = study::stepsTable(*subject, 1e-6, flags.methods);
    const pipeline::Machine machine = pipeline::machine();
    output.write(subject->name() + ".csv", study::workPrecisionCsv(result));
    output.write(subject->name() + ".json", study::workPrecisionJson(result, steps, machineFacts(machine)));
    printResults(result, steps);
    for (const study::NamedChart& drawn : study::workPrecisionCharts(result, {machineNote(machine)}))
        output.draw(subject->name() + "-" + drawn.name, drawn.chart);
    return output.finish(interruption);
}

Action declareChart(Options& options) {
    const auto flags = std::make_shared<ChartFlags>();
    options.value("PROBLEM", flags->subject,
                  "A built-in problem, a scene file, a shipped scene, refinement or contact");
    options.flag("--list", flags->list, "List the built-in problems");
    options.value("-o,--output", flags->output, "Folder for CSV, JSON, SVG and PNG; default out/charts/NAME")
        .typeName("FOLDER");
    options.value("--methods", flags->methods, "Methods, separated by commas; default all")
        .separatedBy(',')
        .oneValue()
        .typeName("A,B");
    options.value("--precision", flags->precision, "Precision: single, double or both")
        .oneOf({"single", "double", "both"});
    options.value("--seconds", flags->seconds, "Simulated time").check(numberWithin(leastSeconds, mostSeconds));
    options.value("--budget", flags->budget, "Wall time to aim at, in seconds").check(numberWithin(0.5, mostSeconds));
    addOverrideFlag(options, flags->overrides, "Override a field of a scene; repeatable");
    options.flag("--quiet", flags->quiet, "Print no progress");
    options.footer(
        "Examples:\n"
        "  taut chart cloth-corners\n"
        "  taut chart growth --methods euler,rk4 -o out/growth\n"
        "  taut chart flag --seconds 0.5 --precision double\n"
        "  taut chart refinement\n"
        "  taut chart contact -o charts");
    return withThreads(options, [flags] { return chart(*flags); });
}

}  // namespace

Command chartCommand() {
    return {"chart", "Chart error against cost for every method and step", declareChart};
}

}  // namespace taut::game
