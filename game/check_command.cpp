#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "taut/core/error.h"
#include "game/commands.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

struct CheckFlags {
    std::vector<std::string> scenes;
    std::vector<std::string> overrides;
};

// Reads and builds each scene; goes on after one that is wrong, and returns the code of the first failure.
int check(const CheckFlags& flags) {
    auto code = core::ExitCode::ok;
    for (const std::string& argument : flags.scenes) {
        try {
            const world::SceneSpec spec = readScene(argument, flags.overrides);
            const world::World built(spec);
            printWarnings(built.warnings());
            fmt::print("{}: ok\n", spec.file);
        } catch (const core::Error& error) {
            printError(error);
            if (code == core::ExitCode::ok) code = error.code();
        }
    }
    return static_cast<int>(code);
}

}  // namespace

void addCheck(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<CheckFlags>();
    CLI::App* command = app.add_subcommand("check", "Say whether scene files are right, with all their errors");
    command->add_option("SCENE", flags->scenes, "Scene files, or names of shipped scenes")->required();
    command->add_option("--set", flags->overrides, "Override a field: --set cloth.flag.cells=[72,48]")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command->callback([&chosen, flags] { chosen = [flags] { return check(*flags); }; });
}

}  // namespace taut::game
