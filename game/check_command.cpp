#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/messages.h"
#include "game/outputs.h"
#include "game/scene_file.h"
#include "taut/core/error.h"
#include "taut/pipeline/run.h"
#include "taut/advice/rehearsal.h"

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

// Reads, builds and rehearses each scene; goes on after one that is wrong, and returns the code of the first failure.
int check(const CheckFlags& flags) {
    ExitCode code = ExitCode::ok;
    for (const std::string& argument : flags.scenes) {
        try {
            const world::SceneSpec spec = readScene(argument, flags.overrides, flags.isConfined);
            notePreparation(spec);
            const world::Rehearsal rehearsal = world::rehearse(spec);
            printWarnings(rehearsal.warnings);
            printAdvice(rehearsal.advice);
            if (!rehearsal.faults.empty())
                throw core::Error(core::ErrorKind::badContent, fmt::format("{}", fmt::join(rehearsal.faults, "\n")));
            printResult("{}: ok\n", spec.file);
            const std::string large =
                largeRunText(pipeline::frameCount(spec.run), spec.picture.size.x, spec.picture.size.y);
            if (!large.empty()) printResult("{}: {}\n", spec.file, large);
        } catch (const core::Error& error) {
            printError(error);
            if (code == ExitCode::ok) code = exitCodeOf(error.kind());
        }
    }
    return static_cast<int>(code);
}

Action declareCheck(Options& options) {
    const auto flags = std::make_shared<CheckFlags>();
    options.value("SCENE", flags->scenes, "Scene files, or names of shipped scenes").required();
    options.value("--set", flags->overrides, "Override a field: --set cloth.flag.cells=[72,48]")
        .typeName("KEY=VALUE")
        .oneValue();
    addConfinedFlag(options, flags->isConfined);
    return [flags] { return check(*flags); };
}

}  // namespace

Command checkCommand() {
    return {"check", "Say whether scene files are right, with all their errors", declareCheck};
}

}  // namespace taut::game
