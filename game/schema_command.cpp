#include <fmt/format.h>

#include <memory>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/messages.h"
#include "taut/scene/load.h"

namespace taut::game {
namespace {

Action declareSchema(Options& options) {
    const auto manual = std::make_shared<bool>(false);
    options.flag("--manual", *manual, "Print a text instead: every field with its unit, range and default");
    return [manual] {
        writeResult((*manual ? scene::manual() : scene::jsonSchema()) + "\n");
        return static_cast<int>(ExitCode::ok);
    };
}

}  // namespace

Command schemaCommand() {
    return {"schema", "Print the scene format as a JSON schema", declareSchema};
}

}  // namespace taut::game
