// All commands of the program: a value, to which another program may add commands of its own. A new one is one file
// with what it takes, what it does and its row, and one line in command_table.cpp.
#pragma once

#include <vector>

#include "game/command_line.h"
#include "game/tables.h"

namespace taut::game {

// In the order in which the help names them.
std::vector<Command> builtInCommands(const Tables& tables = {});

}  // namespace taut::game
