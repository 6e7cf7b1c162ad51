// Words of a command line that a person can copy into a shell. It knows no command.
#pragma once

#include <string>

namespace taut::game {

// Quoted if the shell would read it differently.
std::string shellWord(const std::string& word);

}  // namespace taut::game
