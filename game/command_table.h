// All commands of the program, as a value to which another program may add commands. A new command is one file with its
// options, its action and its row, and one line in command_table.cpp.
#pragma once

#include <vector>

#include "game/command_line.h"
#include "game/tables.h"

namespace taut::game {

// In the order of the help.
std::vector<Command> builtInCommands(const Tables& tables = {});

}  // namespace taut::game
