// Scripts by which shells complete the command line, made from what the commands say of themselves. It knows none of
// them.
#pragma once

#include <string>

#include "game/command_tree.h"

namespace taut::game {

// Names of scenes are asked of the program whenever they are needed, by its command `completion --scenes`.
std::string bashCompletion(const CommandTree& tree);
std::string zshCompletion(const CommandTree& tree);
std::string fishCompletion(const CommandTree& tree);

}  // namespace taut::game
