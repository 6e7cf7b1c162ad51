// The command line: commands with their flags, options and words, as values of its own. It knows no command, and hides
// the library that reads the words.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "game/command_tree.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace taut::game {

// Something that a command takes. Each call adds to its description, and calls may be chained.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    Option required() const;
    // The type in the help, instead of TEXT, INT or FLOAT. Shells complete FILE and TEXT to files, FOLDER to folders.
    // They complete words named SCENE, SCENARIO or PROBLEM, or a TEXT whose flag has such a name, to scenes.
    Option typeName(const std::string& name) const;
    Option showDefault() const;                // in the help: the present value of the target
    Option separatedBy(char separator) const;  // several values in one word
    Option oneValue() const;                   // takes one value each time, though it may be given often
    Option mayBeBare() const;                  // if given without a value, it counts as given and leaves its target

    // The allowed values; numbers are int, std::int64_t or double.
    template <class Number>
    Option within(Number least, Number most, const std::string& unit = {}) const;  // unit: for messages
    Option oneOf(const std::vector<std::string>& words) const;
    Option suggests(const std::vector<std::string>& words) const;  // in the help and to a shell; others are allowed
    // check() returns an empty text if the value is good, else its fault.
    Option check(std::function<std::string(const std::string& text)> check) const;

    Option excludes(const Option& other) const;
    Option each(std::function<void(const std::string& text)> take) const;  // called for every value

    // Valid once the line is read.
    bool isGiven() const;

  private:
    CLI::Option* option_;
};

// The arguments of one command. Targets must live as long as the return value of the command's `declare`.
class Options {
  public:
    explicit Options(CLI::App& app) : app_(app) {}

    // "-y,--yes": true when it is given.
    Option flag(const std::string& names, bool& target, const std::string& help);

    // "-o,--output VALUE", or a positional word if the name has no dashes. The target is a std::string, a list of
    // strings, int, std::int64_t, double, or an optional one of these.
    template <class Target>
    Option value(const std::string& names, Target& target, const std::string& help);

    // A removed flag: it stands in no help, and its use is an error with a remedy.
    void gone(const std::string& name, const std::string& instead);

    // The heading under which the help lists the flags that follow.
    void group(const std::string& name) { group_ = name; }

    // The end of the help.
    void footer(const std::string& text);

    // All that the program takes, for this and the other commands. Call it from an action.
    std::function<CommandTree()> tree() const;
    // The help of a command, or of the program if empty; throws core::Error(usage) if there is none of that name. Call
    // it from an action.
    std::function<std::string(const std::string& command)> help() const;

  private:
    Option add(CLI::Option* option) const;

    CLI::App& app_;
    std::string group_;
};

using Action = std::function<int()>;  // returns the exit code

// A row of the table of commands.
struct Command {
    std::string_view name;
    std::string_view help;  // one line
    // Declares the arguments of the command. Returns the action that runs if the command is chosen.
    std::function<Action(Options& options)> declare;
};

// The request of a command line.
struct Request {
    enum class Kind {
        run,      // action
        text,     // to be printed: help or version
        nothing,  // the line has no word
        wrong,    // `text` has the fault; `command`, "taut render", has the help
    };
    Kind kind = Kind::nothing;
    Action action;
    std::string text;
    std::string command;
};

class CommandLine {
  public:
    struct About {
        std::string name, description, version, footer;
    };
    CommandLine(const About& about, std::span<const Command> commands);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    // The result is valid as long as this object lives.
    Request read(int argc, const char* const* argv);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::game
