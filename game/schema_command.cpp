#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "taut/core/error.h"
#include "game/commands.h"
#include "taut/scene/load.h"

namespace taut::game {

void addSchema(CLI::App& app, Action& chosen) {
    const auto manual = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("schema", "Print the scene format as a JSON schema, for editors");
    command->add_flag("--manual", *manual, "Print it for people: every field with its unit, range and default");
    command->callback([&chosen, manual] {
        chosen = [manual] {
            fmt::print("{}\n", *manual ? scene::manual() : scene::jsonSchema());
            return static_cast<int>(core::ExitCode::ok);
        };
    });
}

}  // namespace taut::game
