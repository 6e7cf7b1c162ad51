// Scripts by which shells complete the command line, made from the descriptions of the commands. It knows none of them.
#pragma once

#include <string>

#include "game/command_tree.h"

namespace taut::game {

// Scripts ask the program for scene names when needed, by its command `completion --scenes`.
std::string bashCompletion(const CommandTree& tree);
std::string zshCompletion(const CommandTree& tree);
std::string fishCompletion(const CommandTree& tree);

}  // namespace taut::game
