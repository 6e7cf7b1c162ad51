#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/interruption.h"
#include "game/lab.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/core/whole_file.h"
#include "taut/regression/tape.h"
#include "taut/regression/tape_compare.h"
#include "taut/scene/load.h"
#include "taut/world/result_bits.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

struct ReplayFlags {
    std::string tape, other, scene;
    int threads = 0;
    bool verify = false, quiet = false;
};

bool hasPoints(const regression::Tape& tape) {
    return !tape.points.empty();
}

void printFacts(const std::string& name, const regression::Tape& tape) {
    const regression::TapeOrigin& origin = tape.origin;
    const bool isBlankFirst = tape.casts.front().names.empty() && tape.casts.size() > 1;  // before a kept state
    printResult("{}\n  {} ticks of {:.6g} s, {} a picture, hashes of {} bodies{}\n", name, tape.ticks(),
                tape.tickSeconds, tape.ticksPerFrame, tape.casts[isBlankFirst ? 1 : 0].names.size(),
                hasPoints(tape) ? " and of their points" : "");
    if (!origin.scene.empty()) printResult("  scene {}\n", origin.scene);
    for (const scene::UsedFile& file : origin.files)
        if (file.path != origin.scene) printResult("  depends on {}\n", file.path);
    for (const std::string& override_ : origin.overrides) printResult("  --set {}\n", override_);
    printResult("  by {}, {}, {}, bits {}\n  last hash {:016x}\n", origin.program, origin.compiler, origin.simd,
                origin.bits, tape.chain.back());
}

// The scene of a tape, or the scene to compare with it.
world::SceneSpec sceneOf(const ReplayFlags& flags, const regression::Tape& tape) {
    const scene::LoadOptions options = loadOptions(tape.origin.overrides);
    if (!flags.scene.empty()) {
        scene::Loaded loaded = scene::loadScene(sceneFile(flags.scene), options);
        printWarnings(loaded.warnings);
        return std::move(loaded.spec);
    }
    if (tape.origin.text.empty())
        failUsage("{}: this tape holds no scene (it is the golden of a scenario): name one with --scene", flags.tape);
    if (tape.origin.files.empty() &&
        (!core::isThere(tape.origin.scene) || core::fileContent(tape.origin.scene) != tape.origin.text))
        printWarning(fmt::format("{} has changed; the text on the tape is played", tape.origin.scene));
    for (const std::string& change : scene::changedSince(tape.origin.files)) {
        const bool isScene = change.starts_with(tape.origin.scene + " ");
        printWarning(fmt::format("{} since this tape was recorded{}", change,
                                 isScene ? "; the text on the tape is played" : ""));
    }
    return scene::loadSceneText(tape.origin.text, tape.origin.scene, options).spec;
}

// Plays until the tape ends or the chain differs.
regression::Tape played(const ReplayFlags& flags, const regression::Tape& tape, const Interruption& interruption) {
    const core::ThreadLimit limit(flags.threads);
    world::World world(sceneOf(flags, tape), {.threads = flags.threads});
    regression::Tape now = regression::blankTape();
    LabProgress progress("replay", flags.quiet, interruption.flag());
    const auto goesOn = [&] {
        progress.show(static_cast<double>(world.tick()) / static_cast<double>(tape.ticks()),
                      fmt::format("{:.2f} s", world.time()));
        const auto at = static_cast<std::size_t>(world.tick());
        return !interruption.flag() && at < tape.chain.size() && now.chain[at] == tape.chain[at];
    };
    if (const auto divergence = regression::addTicks(now, world, tape.ticks(), hasPoints(tape), goesOn))
        throw core::Error(core::ErrorKind::diverged, fmt::format("at tick {} of the tape's {}\n{}", world.tick(),
                                                                 tape.ticks(), divergence->message));
    return now;
}

int verdict(const ReplayFlags& flags, const regression::Tape& tape, const regression::Tape& now) {
    auto difference = regression::firstDifference(tape, now);
    if (!difference) {
        printResult("the same state at all {} ticks, to the last bit\n", tape.ticks());
        return static_cast<int>(ExitCode::ok);
    }
    printResult("{}\n", regression::describe(*difference));
    const auto by = [](const regression::TapeOrigin& origin) {
        return fmt::format("{}, {}, {}, bits {}", origin.program, origin.compiler, origin.simd, origin.bits);
    };
    printResult("  {}: by {}\n  {}: by {}\n", flags.tape, by(tape.origin),
                flags.other.empty() ? "now" : flags.other.c_str(), by(now.origin));
    if (difference->fault == regression::TapeFault::state && difference->point < 0)
        printResult("  two tapes with points show the point (taut record without --no-points)\n");
    return static_cast<int>(ExitCode::checkFailed);
}

int replay(const ReplayFlags& flags) {
    const regression::Tape tape = regression::readTape(flags.tape);
    if (!flags.verify) {
        if (!flags.scene.empty()) failUsage("--scene needs --verify");
        printFacts(flags.tape, tape);
        return static_cast<int>(ExitCode::ok);
    }
    if (!flags.other.empty()) {
        if (!flags.scene.empty()) failUsage("--verify with a second tape plays nothing: omit --scene");
        if (std::filesystem::path(flags.other).extension() == ".toml")
            failUsage("--verify reads a second tape; a scene is played by --verify --scene {}", flags.other);
        return verdict(flags, tape, regression::readTape(flags.other));
    }
    if (tape.origin.bits != world::resultBits) {
        printResult("{}: {}: {}\n", flags.tape, world::recordedBy(tape.origin.bits),
                    tape.origin.bits < world::resultBits ? "results have changed since; taut record writes it again"
                                                         : "it needs a newer taut");
        return static_cast<int>(ExitCode::goldenMissing);
    }
    const Interruption interruption;
    const regression::Tape now = played(flags, tape, interruption);
    if (interruption.exitCode()) return static_cast<int>(*interruption.exitCode());
    return verdict(flags, tape, now);
}

Action declareReplay(Options& options) {
    const auto flags = std::make_shared<ReplayFlags>();
    options.value("TAPE", flags->tape, "A tape of taut record").required();
    const Option verify =
        options
            .value("--verify", flags->other,
                   "Simulate again, or read the tape OTHER, and name the first tick, body and point that differ")
            .typeName("[OTHER]")
            .mayBeBare();
    options.value("--scene", flags->scene, "Simulate this scene instead of the one on the tape");
    addThreadsFlag(options, flags->threads);
    options.flag("--quiet", flags->quiet, "Print no progress");
    return [flags, verify] {
        flags->verify = verify.isGiven();
        return replay(*flags);
    };
}

}  // namespace

Command replayCommand() {
    return {"replay", "Show a tape, or compare it with another run", declareReplay};
}

}  // namespace taut::game
