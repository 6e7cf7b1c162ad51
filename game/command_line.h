// The command line: commands, and the flags, options and words that each of them takes, as values of its own. It knows
// no command, and hides the library that reads the words.
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

// Something that a command takes, just declared: each call says more of it, and all may follow one another.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    Option required() const;
    // In the help, instead of TEXT, INT or FLOAT. Shells complete FILE and TEXT to files, FOLDER to folders, and words
    // named SCENE, SCENARIO or PROBLEM, or a TEXT whose flag has such a name, to scenes.
    Option typeName(const std::string& name) const;
    Option showDefault() const;                // in the help: what the target holds now
    Option separatedBy(char separator) const;  // several values in one word
    Option oneValue() const;                   // one each time that it is given, though it may be given often
    Option mayBeBare() const;                  // without a value it counts as given, and leaves its target

    // What values may be; numbers are int, std::int64_t or double.
    template <class Number>
    Option within(Number least, Number most, const std::string& unit = {}) const;  // unit: for who is outside
    Option oneOf(const std::vector<std::string>& words) const;
    Option suggests(const std::vector<std::string>& words) const;  // in the help and to a shell; others may do, too
    // Empty when the text will do, else what is wrong with it.
    Option check(std::function<std::string(const std::string& text)> check) const;

    Option excludes(const Option& other) const;
    Option each(std::function<void(const std::string& text)> take) const;  // called for every value

    // Once the line is read.
    bool isGiven() const;

  private:
    CLI::Option* option_;
};

// What one command takes. Targets have to live as long as what the command's `declare` returns.
class Options {
  public:
    explicit Options(CLI::App& app) : app_(app) {}

    // "-y,--yes": true when it is given.
    Option flag(const std::string& names, bool& target, const std::string& help);

    // "-o,--output VALUE", or, of a name without dashes, a word that stands for itself. The target is a std::string, a
    // list of them, int, std::int64_t, double, or one of these that may be left out.
    template <class Target>
    Option value(const std::string& names, Target& target, const std::string& help);

    // Ends the help.
    void footer(const std::string& text);

    // All that the program takes, of this and the other commands; to be called by an action.
    std::function<CommandTree()> tree() const;

  private:
    CLI::App& app_;
};

using Action = std::function<int()>;  // returns the exit code

// A row of the table of commands.
struct Command {
    std::string_view name;
    std::string_view help;  // one line
    // Says what it takes; returns what is done when it is the one that is chosen.
    std::function<Action(Options& options)> declare;
};

// What a command line asks for.
struct Request {
    enum class Kind {
        run,      // action
        text,     // to be printed: a help or the version
        nothing,  // no word stands on the line
        wrong,    // text says what, `command` whose help may tell more: "taut render"
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

    // What it returns may be used as long as this lives.
    Request read(int argc, const char* const* argv);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::game
