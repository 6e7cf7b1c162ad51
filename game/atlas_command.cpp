#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/flags.h"
#include "game/interruption.h"
#include "game/lab.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "game/usage.h"
#include "taut/pipeline/machine.h"
#include "taut/study/atlas_chart.h"
#include "taut/study/atlas_text.h"
#include "taut/study/phase_plane.h"
#include "taut/study/stability_map.h"
#include "taut/study/threshold.h"

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

std::vector<std::string> footOf(const pipeline::Machine& machine) {
    return {fmt::format("{}; {}", programText(machine), machine.compiler)};
}

LabFolder folderOf(const AtlasFlags& flags, const std::string& fallback) {
    return {flags.output.empty() ? fallback : flags.output, flags.quiet};
}

int oscillatorAtlas(const AtlasFlags& flags) {
    if (!flags.overrides.empty() || flags.seconds > 0.0) failUsage("--set and --seconds apply to scenes: name one");
    const Interruption interruption;
    const LabFolder output = folderOf(flags, "out/atlas");
    study::StabilityMapSettings settings;
    settings.methods = flags.methods;
    settings.columns = flags.cells;
    settings.boundaries = std::min(settings.boundaries, flags.cells);
    const study::StabilityMap map = followed("atlas", flags.quiet, interruption, settings, study::measureStability);
    if (map.isInterrupted) return output.abandon(interruption);  // half a map says nothing
    const std::vector<study::PhasePath> paths = study::phasePaths(flags.methods);
    const pipeline::Machine machine = pipeline::machine();
    output.write("stability-map.csv", study::boundariesCsv(map));
    output.write("stability-growth.csv", study::growthCsv(map));
    output.write("phase-plane.csv", study::phasePlaneCsv(paths));
    printResult("{}", study::stabilitySummary(map));
    output.draw("stability-map", study::stabilityChart(map, footOf(machine)));
    output.draw("phase-plane", study::phasePlaneChart(paths, footOf(machine)));
    return output.finish(interruption);
}

// "rope" and "cloth", a shipped scene, or a file.
world::SceneSpec chosenScene(const AtlasFlags& flags, std::string& name) {
    name = flags.scene;
    if (study::isReferenceNetwork(flags.scene)) {
        if (!flags.overrides.empty()) failUsage("--set changes fields of scene files; {} is built in", flags.scene);
        return study::referenceNetwork(flags.scene);
    }
    name = sceneFile(flags.scene).stem().string();
    return readScene(flags.scene, flags.overrides);
}

int sceneAtlas(const AtlasFlags& flags) {
    std::string name;
    const world::SceneSpec spec = chosenScene(flags, name);
    const Interruption interruption;
    const LabFolder output = folderOf(flags, "out/atlas/" + name);
    const study::SceneThresholds thresholds =
        followed("atlas", flags.quiet, interruption,
                 study::ThresholdSettings{.methods = flags.methods, .seconds = flags.seconds},
                 [&](const study::ThresholdSettings& settings) { return findThresholds(spec, name, settings); });
    if (thresholds.isInterrupted) return output.abandon(interruption);
    const pipeline::Machine machine = pipeline::machine();
    output.write(name + "-thresholds.csv", study::thresholdsCsv(thresholds));
    output.write(name + "-thresholds.json", study::thresholdsJson(thresholds, machineFacts(machine)));
    printResult("{}", study::thresholdsSummary(thresholds));
    output.draw(name + "-thresholds", study::thresholdChart(thresholds, footOf(machine)));
    return output.finish(interruption);
}

int atlas(const AtlasFlags& flags) {
    checkMethods(flags.methods);
    return flags.scene.empty() ? oscillatorAtlas(flags) : sceneAtlas(flags);
}

Action declareAtlas(Options& options) {
    const auto flags = std::make_shared<AtlasFlags>();
    options.value("SCENE", flags->scene,
                  "A scene file, a shipped scene, or the built-in rope or cloth: measures the largest stable step of "
                  "each method. Without it: maps of the damped oscillator");
    options.value("-o,--output", flags->output, "Folder for CSV, JSON, SVG and PNG; default out/atlas")
        .typeName("FOLDER");
    options.value("--methods", flags->methods, "Methods, separated by commas; default all")
        .separatedBy(',')
        .oneValue()
        .typeName("A,B");
    options.value("--cells", flags->cells, "Points of a map along each axis").within(3, 1001);
    options.value("--seconds", flags->seconds, "Simulated time of each run of a scene; default at most 0.5")
        .check(numberWithin(leastSeconds, mostSeconds));
    addOverrideFlag(options, flags->overrides, "Override a field of a scene; repeatable");
    options.flag("--quiet", flags->quiet, "Print no progress");
    options.footer(
        "Examples:\n"
        "  taut atlas\n"
        "  taut atlas rope\n"
        "  taut atlas flag --methods leapfrog,rk4 --seconds 0.5");
    return withThreads(options, [flags] { return atlas(*flags); });
}

}  // namespace

Command atlasCommand() {
    return {"atlas", "Map where each method becomes unstable", declareAtlas};
}

}  // namespace taut::game
