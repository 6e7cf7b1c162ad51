#include "game/command_table.h"

// A line a command, in the order in which the help names them: the function that returns its row.
#define TAUT_COMMANDS(COMMAND) \
    COMMAND(renderCommand)     \
    COMMAND(joinCommand)       \
    COMMAND(playCommand)       \
    COMMAND(exportCommand)     \
    COMMAND(checkCommand)      \
    COMMAND(infoCommand)       \
    COMMAND(chartCommand)      \
    COMMAND(atlasCommand)      \
    COMMAND(planCommand)       \
    COMMAND(testCommand)       \
    COMMAND(recordCommand)     \
    COMMAND(replayCommand)     \
    COMMAND(sheetCommand)      \
    COMMAND(schemaCommand)     \
    COMMAND(doctorCommand)     \
    COMMAND(manualCommand)     \
    COMMAND(completionCommand)

namespace taut::game {

#define TAUT_DECLARE(command) Command command();
TAUT_COMMANDS(TAUT_DECLARE)
#undef TAUT_DECLARE

std::vector<Command> builtInCommands() {
    std::vector<Command> all;
#define TAUT_ADD(command) all.push_back(command());
    TAUT_COMMANDS(TAUT_ADD)
#undef TAUT_ADD
    return all;
}

}  // namespace taut::game
