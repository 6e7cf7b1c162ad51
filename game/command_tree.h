// The arguments of a command line, as plain values. Manual pages and shell completion are made from them. Independent
// of commands.
#pragma once

#include <string>
#include <vector>

namespace taut::game {

struct OptionFacts {
    std::vector<std::string> names;  // "-o", "--output"; a positional word has one name without dashes
    std::string value;               // the name of its value in the help: "FILE", "TEXT"; empty for a flag
    std::vector<std::string> words;  // all its values, or most of them; empty if the list would not be short
    std::string range;               // "1 - 1024"; empty without one
    std::string standard;            // its value if not given; empty if the help does not say
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
    CommandFacts program;  // arguments of the program without a command
    std::vector<CommandFacts> commands;
};

}  // namespace taut::game
