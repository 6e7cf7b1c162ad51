// Words of a command line, as a person copies them into a shell. It knows no command.
#pragma once

#include <string>

namespace taut::game {

// Quoted where the shell would read something else in it.
std::string shellWord(const std::string& word);

}  // namespace taut::game
