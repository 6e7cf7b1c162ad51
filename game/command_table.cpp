#include "game/command_table.h"

// A line a command, in the order in which the help names them: the function that returns its row. CHOOSING: it takes
// the tables that the command chooses from.
#define TAUT_COMMANDS(COMMAND, CHOOSING) \
    CHOOSING(renderCommand)              \
    COMMAND(listCommand)                 \
    COMMAND(joinCommand)                 \
    COMMAND(playCommand)                 \
    CHOOSING(exportCommand)              \
    COMMAND(newCommand)                  \
    COMMAND(materialsCommand)            \
    COMMAND(checkCommand)                \
    COMMAND(infoCommand)                 \
    COMMAND(chartCommand)                \
    COMMAND(atlasCommand)                \
    COMMAND(realityCommand)              \
    COMMAND(planCommand)                 \
    COMMAND(fitCommand)                  \
    COMMAND(testCommand)                 \
    COMMAND(recordCommand)               \
    COMMAND(replayCommand)               \
    COMMAND(sheetCommand)                \
    COMMAND(schemaCommand)               \
    COMMAND(doctorCommand)               \
    COMMAND(helpCommand)                 \
    COMMAND(manualCommand)               \
    COMMAND(completionCommand)

namespace taut::game {

#define TAUT_DECLARE(command) Command command();
#define TAUT_DECLARE_CHOOSING(command) Command command(const Tables& tables);
TAUT_COMMANDS(TAUT_DECLARE, TAUT_DECLARE_CHOOSING)
#undef TAUT_DECLARE
#undef TAUT_DECLARE_CHOOSING

std::vector<Command> builtInCommands(const Tables& tables) {
    std::vector<Command> all;
#define TAUT_ADD(command) all.push_back(command());
#define TAUT_ADD_CHOOSING(command) all.push_back(command(tables));
    TAUT_COMMANDS(TAUT_ADD, TAUT_ADD_CHOOSING)
#undef TAUT_ADD
#undef TAUT_ADD_CHOOSING
    return all;
}

}  // namespace taut::game
