#include <fmt/format.h>

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
#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/run.h"
#include "taut/regression/tape.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

struct RecordFlags {
    std::string scene, output;
    std::vector<std::string> overrides;
    double seconds = 0.0;
    int threads = 0;
    bool yes = false, noPoints = false, quiet = false;
};

// The tape keeps the text that it plays, so that it can be played again when the file has changed.
world::SceneSpec readRecorded(const std::filesystem::path& file, const RecordFlags& flags, regression::Tape& tape) {
    std::error_code ignored;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(file, ignored);
    tape.origin.scene = whole.string();
    tape.origin.text = core::fileContent(file);
    tape.origin.overrides = flags.overrides;
    if (flags.seconds > 0.0) tape.origin.overrides.push_back(fmt::format("run.seconds={}", flags.seconds));
    scene::Loaded loaded =
        scene::loadSceneText(tape.origin.text, tape.origin.scene, loadOptions(tape.origin.overrides));
    printWarnings(loaded.warnings);
    tape.origin.files = scene::usedFiles(loaded.spec);
    return std::move(loaded.spec);
}

int record(const RecordFlags& flags) {
    const std::filesystem::path output = flags.output;
    std::error_code ignored;
    if (!flags.yes && std::filesystem::exists(output, ignored))
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{} exists already; -y overwrites it", output.string()));
    regression::Tape tape = regression::blankTape();
    const world::SceneSpec spec = readRecorded(sceneFile(flags.scene), flags, tape);
    core::prepareFolderOf(output);

    const Interruption interruption;
    if (!flags.quiet) notePreparation(spec);
    const core::ThreadLimit limit(flags.threads);
    world::World world(spec, {.threads = flags.threads});
    const std::int64_t last = (pipeline::frameCount(spec.run) - 1) * world.ticksPerFrame();
    LabProgress progress("record", flags.quiet, interruption.flag());
    const auto divergence = regression::addTicks(tape, world, last, !flags.noPoints, [&] {
        progress.show(static_cast<double>(world.tick()) / static_cast<double>(last),
                      fmt::format("{:.2f} s", world.time()));
        return !interruption.flag();
    });
    regression::writeTape(output, tape);
    printResult("{}: {} ticks, {:.4g} s, last hash {:016x}\n", output.string(), tape.ticks(),
                static_cast<double>(tape.ticks()) * tape.tickSeconds, tape.chain.back());
    if (divergence) throw core::Error(core::ErrorKind::diverged, divergence->message);
    return static_cast<int>(interruption.exitCode().value_or(ExitCode::ok));
}

Action declareRecord(Options& options) {
    const auto flags = std::make_shared<RecordFlags>();
    options.value("SCENE", flags->scene, "A scene file, or the name of a shipped scene").required();
    options.value("-o,--output", flags->output, "Tape to write, e.g. run.tape").required();
    options.flag("-y,--yes", flags->yes, "Overwrite existing files");
    options.flag("--no-points", flags->noPoints, "Record hashes of bodies only: a smaller tape without points");
    options.value("--seconds", flags->seconds, "Length in scene time").check(numberWithin(leastSeconds, mostSeconds));
    addThreadsFlag(options, flags->threads);
    addOverrideFlag(options, flags->overrides);
    options.flag("--quiet", flags->quiet, "Print no progress");
    return [flags] { return record(*flags); };
}

}  // namespace

Command recordCommand() {
    return {"record", "Record the hashes of every tick, for taut replay", declareRecord};
}

}  // namespace taut::game
