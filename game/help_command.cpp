#include <memory>
#include <string>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/messages.h"

namespace taut::game {
namespace {

Action declareHelp(Options& options) {
    const auto command = std::make_shared<std::string>();
    options.value("COMMAND", *command, "A command; default the program itself");
    return [command, help = options.help()] {
        printText(help(*command));
        return static_cast<int>(ExitCode::ok);
    };
}

}  // namespace

Command helpCommand() {
    return {"help", "Print the help of a command", declareHelp};
}

}  // namespace taut::game
