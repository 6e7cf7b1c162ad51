// What a command line takes, as plain values: what a manual and the completion of a shell are made of. It knows no
// command.
#pragma once

#include <string>
#include <vector>

namespace taut::game {

struct OptionFacts {
    std::vector<std::string> names;  // "-o", "--output"; of a word that stands for itself one name without dashes
    std::string value;               // what the help calls its value: "FILE", "TEXT"; empty for a flag
    std::vector<std::string> words;  // all that the value may be, or most of it; empty where that is no short list
    std::string range;               // "1 - 1024"; empty without one
    std::string standard;            // what it is when it is not given; empty when the help says no more
    std::string help;
    bool isRequired = false;
    bool isRepeatable = false;

    bool isPositional() const { return !names.front().starts_with('-'); }
};

struct CommandFacts {
    std::string name, help, footer;
    std::vector<OptionFacts> options;
};

struct CommandTree {
    CommandFacts program;  // what it takes without a command
    std::vector<CommandFacts> commands;
};

}  // namespace taut::game
