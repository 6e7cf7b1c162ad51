#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/messages.h"
#include "game/outputs.h"
#include "game/scene_file.h"
#include "taut/advice/figures.h"
#include "taut/advice/rehearsal.h"
#include "taut/core/error.h"
#include "taut/pipeline/run.h"
#include "taut/regression/scenario.h"

namespace taut::game {
namespace {

struct CheckFlags {
    std::vector<std::string> scenes;
    std::vector<std::string> overrides;
    bool isConfined = false;
};

// Copies of a body would say the same again and again.
void printAdvice(const std::vector<std::string>& all) {
    constexpr int most = 5;
    int count = 0;
    for (const std::string& advice : all)
        if (++count <= most) printNote("taut: note: {}\n", advice);
    if (count > most) printNote("taut: note: … and {} more; taut info lists them\n", count - most);
}

// Of a folder the scenes in it, as `taut test` finds scenarios.
std::vector<std::string> scenesOf(const std::vector<std::string>& arguments) {
    std::vector<std::string> scenes;
    for (const std::string& argument : arguments) {
        std::error_code ignored;
        if (!std::filesystem::is_directory(argument, ignored))
            scenes.push_back(argument);
        else
            for (const std::filesystem::path& file : regression::scenarioFilesIn(argument))
                scenes.push_back(file.string());
    }
    return scenes;
}

// Reads, builds and rehearses each scene; goes on after one that is wrong, and returns the worst code.
int check(const CheckFlags& flags) {
    ExitCode code = ExitCode::ok;
    const std::vector<std::string> scenes = scenesOf(flags.scenes);
    for (const std::string& argument : scenes) {
        try {
            const world::SceneSpec spec = readScene(argument, flags.overrides, flags.isConfined);
            notePreparation(spec);
            const world::Rehearsal rehearsal = world::rehearse(spec);
            printWarnings(rehearsal.warnings);
            for (const std::string& note : world::figureNotes(spec)) printNote("taut: note: {}\n", note);
            printAdvice(rehearsal.advice);
            if (!rehearsal.faults.empty())
                throw core::Error(core::ErrorKind::badContent, fmt::format("{}", fmt::join(rehearsal.faults, "\n")));
            printResult("{}: ok\n", spec.file);
            const std::string large =
                largeRunText(pipeline::frameCount(spec.run), spec.picture.size.x, spec.picture.size.y);
            if (!large.empty()) printResult("{}: {}\n", spec.file, large);
        } catch (const core::Error& error) {
            printError(error);
            if (scenes.size() > 1) printResult("{}: wrong\n", argument);
            code = std::max(code, exitCodeOf(error.kind()));
        }
    }
    return static_cast<int>(code);
}

Action declareCheck(Options& options) {
    const auto flags = std::make_shared<CheckFlags>();
    options.value("SCENE", flags->scenes, "Scene files, folders of them, or names of shipped scenes").required();
    addOverrideFlag(options, flags->overrides, "Override a field: --set cloth.flag.cells=[72,48]");
    addConfinedFlag(options, flags->isConfined);
    options.footer(
        "Of a folder every file NAME.toml in it, a line each. The exit code is that of the worst.\n"
        "Examples:\n"
        "  taut check my.toml\n"
        "  taut check my --confined\n"
        "  taut check hammock --set 'rope.*.radius=0.01' --set defaults.rope.segments=20");
    return [flags] { return check(*flags); };
}

}  // namespace

Command checkCommand() {
    return {"check", "Say whether scene files are right, with all their errors", declareCheck};
}

}  // namespace taut::game
