// The manual page of the program, made from the descriptions of its commands. It knows none of them.
#pragma once

#include <string>

#include "game/command_tree.h"

namespace taut::game {

struct ManualAbout {
    std::string date;         // "2026-11-22"
    std::string version;      // "taut 0.1.0"
    std::string explanation;  // the text between the commands and the end, in the language of the page
};

// In the language of man(7), for man, groff and mandoc.
std::string manualPage(const CommandTree& tree, const ManualAbout& about);

}  // namespace taut::game
