// The program: chooses the command, and turns errors into a message and an exit code. It knows no command.
#pragma once

#include <span>

#include "game/command_line.h"

namespace taut::game {

// Returns the exit code. Results go to standard output, everything else to standard error.
int runProgram(int argc, const char* const* argv, std::span<const Command> commands);

// With the program's own commands.
int runProgram(int argc, const char* const* argv);

}  // namespace taut::game
