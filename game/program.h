// The program: chooses the command and turns what goes wrong into a message and an exit code. It knows no command.
#pragma once

namespace taut::game {

// Returns the exit code. Results go to standard output, everything else to standard error.
int runProgram(int argc, const char* const* argv);

}  // namespace taut::game
