#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commit.h"
#include "core/error.h"
#include "game/commands.h"
#include "game/folders.h"
#include "game/interruption.h"
#include "game/live_line.h"
#include "game/messages.h"
#include "game/progress.h"
#include "game/scene_file.h"
#include "game/suggestion.h"
#include "image/whole_file.h"
#include "ode/method_table.h"
#include "pipeline/machine.h"
#include "report/gnuplot.h"
#include "study/atlas_chart.h"
#include "study/atlas_text.h"
#include "study/phase_plane.h"
#include "study/stability_map.h"
#include "study/threshold.h"

namespace taut::game {
namespace {

struct AtlasFlags {
    std::string scene;
    std::string output;
    std::vector<std::string> methods;
    int cells = 101;
    double seconds = 0.0;
    std::vector<std::string> overrides;
    bool quiet = false;
};

void checkMethods(const std::vector<std::string>& wanted) {
    std::vector<std::string> names;
    for (const ode::MethodInfo& method : ode::methods()) names.emplace_back(method.name);
    for (const std::string& name : wanted)
        if (ode::findMethod(name) == nullptr) {
            const std::string hint = didYouMean(name, names);
            throw core::Error(core::ExitCode::usage,
                              fmt::format("there is no method '{}'{}", name,
                                          hint.empty() ? fmt::format("; there are {}", fmt::join(names, ", ")) : hint));
        }
}

// Tells how far the work is and how long it will take, from any thread but one at a time.
class Clock {
  public:
    explicit Clock(const AtlasFlags& flags) : line_(flags.quiet) {}
    void show(const study::AtlasProgress& progress) {
        if (!line_.isDue(progress.done >= 1.0)) return;
        const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        const std::string left =
            progress.done > 0.01 ? clockText(spent * (1.0 / progress.done - 1.0)) + " left" : "time left unknown";
        line_.show(fmt::format("atlas {:3.0f} %  {}  {}", 100 * progress.done, left, progress.doing));
    }

  private:
    LiveLine line_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// What is written, and where.
class Output {
  public:
    Output(const AtlasFlags& flags, const std::string& fallback)
        : folder_(flags.output.empty() ? std::filesystem::path(fallback) : std::filesystem::path(flags.output)),
          draws_(!report::gnuplotVersion().empty()),
          isQuiet_(flags.quiet) {
        image::prepareFolderOf(folder_ / "any");
        if (!draws_) printWarnings({report::gnuplotMissing() + "; only CSV and JSON will be written"});
    }
    void write(const std::string& name, const std::string& text) const { image::writeWholeFile(folder_ / name, text); }
    void draw(const std::string& name, const report::Chart& chart) const {
        if (draws_) report::writeChart(chart, folder_ / name);
    }
    void finish() const {
        if (!isQuiet_) fmt::print(stderr, "in {}\n", folder_.string());
        if (!draws_) throw core::Error(core::ExitCode::inputOutput, "no pictures: " + report::gnuplotMissing());
    }

  private:
    std::filesystem::path folder_;
    bool draws_, isQuiet_;
};

study::MachineFacts machineFacts(const pipeline::Machine& machine) {
    return {{"processor", machine.processor}, {"compiler", machine.compiler}, {"flags", TAUT_FLAGS},
            {"simd", machine.simd},           {"program", machine.program},   {"commit", TAUT_COMMIT},
            {"system", machine.system}};
}

std::vector<std::string> footOf(const pipeline::Machine& machine) {
    return {fmt::format("{}, commit {}; {}", machine.program, TAUT_COMMIT, machine.compiler)};
}

int exitCode(const Interruption& interruption) {
    return static_cast<int>(interruption.exitCode().value_or(core::ExitCode::ok));
}

int oscillatorAtlas(const AtlasFlags& flags) {
    if (!flags.overrides.empty() || flags.seconds > 0.0)
        throw core::Error(core::ExitCode::usage, "--set and --seconds are of scenes: name one");
    const Output output(flags, "out/atlas");
    const Interruption interruption;
    study::StabilityMap map;
    {
        Clock clock(flags);
        study::StabilityMapSettings settings;
        settings.methods = flags.methods;
        settings.columns = flags.cells;
        settings.boundaries = std::min(settings.boundaries, flags.cells);
        settings.stop = &interruption.flag();
        settings.progress = [&](const study::AtlasProgress& progress) { clock.show(progress); };
        map = study::measureStability(settings);
    }
    if (map.isInterrupted) return exitCode(interruption);  // half a map says nothing
    const std::vector<study::PhasePath> paths = study::phasePaths(flags.methods);
    const pipeline::Machine machine = pipeline::machine();
    output.write("stability-map.csv", study::boundariesCsv(map));
    output.write("stability-map.json", study::stabilityJson(map, machineFacts(machine)));
    output.write("stability-growth.csv", study::growthCsv(map));
    output.write("phase-plane.csv", study::phasePlaneCsv(paths));
    fmt::print("{}", study::stabilitySummary(map));
    output.draw("stability-map", study::stabilityChart(map, footOf(machine)));
    output.draw("phase-plane", study::phasePlaneChart(paths, footOf(machine)));
    output.finish();
    return exitCode(interruption);
}

// "rope" and "cloth", a shipped scene, or a file.
world::SceneSpec chosenScene(const AtlasFlags& flags, std::string& name) {
    name = flags.scene;
    if (study::isReferenceNetwork(flags.scene)) {
        if (!flags.overrides.empty())
            throw core::Error(core::ExitCode::usage,
                              "--set changes fields of scene files; " + flags.scene + " is built in");
        return study::referenceNetwork(flags.scene);
    }
    name = sceneFile(flags.scene).stem().string();
    return readScene(flags.scene, flags.overrides);
}

int sceneAtlas(const AtlasFlags& flags) {
    std::string name;
    const world::SceneSpec spec = chosenScene(flags, name);
    const Output output(flags, "out/atlas/" + name);
    const Interruption interruption;
    study::SceneThresholds thresholds;
    {
        Clock clock(flags);
        study::ThresholdSettings settings;
        settings.methods = flags.methods;
        settings.seconds = flags.seconds;
        settings.stop = &interruption.flag();
        settings.progress = [&](const study::AtlasProgress& progress) { clock.show(progress); };
        thresholds = study::findThresholds(spec, name, settings);
    }
    if (thresholds.isInterrupted) return exitCode(interruption);
    const pipeline::Machine machine = pipeline::machine();
    output.write(name + "-thresholds.csv", study::thresholdsCsv(thresholds));
    output.write(name + "-thresholds.json", study::thresholdsJson(thresholds, machineFacts(machine)));
    fmt::print("{}", study::thresholdsSummary(thresholds));
    output.draw(name + "-thresholds", study::thresholdChart(thresholds, footOf(machine)));
    output.finish();
    return exitCode(interruption);
}

int atlas(const AtlasFlags& flags) {
    checkMethods(flags.methods);
    return flags.scene.empty() ? oscillatorAtlas(flags) : sceneAtlas(flags);
}

}  // namespace

void addAtlas(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<AtlasFlags>();
    CLI::App* command = app.add_subcommand("atlas", "Map where each method becomes unstable");
    command->add_option("SCENE", flags->scene,
                        "A scene file, a shipped scene, or the built-in rope or cloth: the largest step that each "
                        "method stands there. Without it, maps of the damped oscillator");
    command->add_option("-o,--output", flags->output, "The folder for CSV, JSON, SVG and PNG; else out/atlas")
        ->type_name("FOLDER");
    command->add_option("--methods", flags->methods, "Only these, separated by commas")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("A,B");
    command->add_option("--cells", flags->cells, "Points of a map along either axis")->check(CLI::Range(3, 1001));
    command->add_option("--seconds", flags->seconds, "Length of motion in each run of a scene; else 0.5 at most")
        ->check(CLI::PositiveNumber);
    command->add_option("--set", flags->overrides, "Override a field of a scene; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command->add_flag("--quiet", flags->quiet, "No progress");
    command->footer(
        "Examples:\n"
        "  taut atlas\n"
        "  taut atlas rope\n"
        "  taut atlas flag --methods leapfrog,rk4 --seconds 0.5");
    command->callback([&chosen, flags] { chosen = [flags] { return atlas(*flags); }; });
}

}  // namespace taut::game
