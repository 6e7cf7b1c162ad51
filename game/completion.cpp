#include "game/completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "game/shell_word.h"

namespace taut::game {
namespace {

// How a value is completed: a case of the script for bash, and the text for zsh and fish; {} are its words.
struct Way {
    const char *bash, *zsh, *fish;
};
constexpr Way byWords{"words", "({})", " -x -a '{}'"};
constexpr Way byScenes{"scene", "_PROGRAM_scenes",
                       " -x -a '(PROGRAM completion --scenes; __fish_complete_suffix .toml)'"};
constexpr Way byFiles{"file", "_files", " -r -F"};
constexpr Way byFolders{"folder", "_files -/", " -x -a '(__fish_complete_directories)'"};
constexpr Way byNothing{"nothing", " ", " -x"};

// By the names that Option::typeName tells of.
const Way& wayOf(const OptionFacts& option) {
    if (!option.words.empty()) return byWords;
    std::string name = option.value;
    if (name == "TEXT") name = option.names.back().substr(option.names.back().find_first_not_of('-'));
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
    for (const char* scene : {"SCENE", "SCENARIO", "PROBLEM"})
        if (name.starts_with(scene)) return byScenes;
    if (name == "FOLDER") return byFolders;
    return option.value == "TEXT" || option.value == "FILE" ? byFiles : byNothing;
}

std::string withWords(const char* how, const OptionFacts& option) {
    return fmt::format(fmt::runtime(how), fmt::join(option.words, " "));
}

// The word that a command takes first, if any.
const OptionFacts* firstWord(const CommandFacts& command) {
    const auto found = std::ranges::find_if(command.options, &OptionFacts::isPositional);
    return found == command.options.end() ? nullptr : &*found;
}

std::string bashFlags(const CommandFacts& command) {
    std::vector<std::string> names;
    for (const OptionFacts& option : command.options)
        if (!option.isPositional()) names.insert(names.end(), option.names.begin(), option.names.end());
    return fmt::format("{}", fmt::join(names, " "));
}

std::string bashKind(const OptionFacts& option) {
    return fmt::format("kind={} words='{}'", wayOf(option).bash, fmt::join(option.words, " "));
}

std::string bashCase(const CommandFacts& command) {
    std::string out = fmt::format("        {})\n            flags='{}'", command.name, bashFlags(command));
    if (const OptionFacts* word = firstWord(command)) out += " " + bashKind(*word);
    out += "\n            case $previous in\n";
    for (const OptionFacts& option : command.options)
        if (!option.isPositional() && !option.value.empty())
            out += fmt::format("                {}) flags= {} ;;\n", fmt::join(option.names, " | "), bashKind(option));
    return out + "            esac\n            ;;\n";
}

const char* const bashHead = R"sh(_PROGRAM() {
    local program=${COMP_WORDS[0]/#\~/$HOME} current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    local command= flags= kind=nothing words= i
    COMPREPLY=()
    # --flag=value are three words.
    if [[ $current == = ]]; then
        current=
    elif [[ $previous == = ]]; then
        previous=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    for ((i = 1; i < COMP_CWORD; ++i)); do
        [[ ${COMP_WORDS[i]} == -* ]] || { command=${COMP_WORDS[i]} && break; }
    done
    case $command in
)sh";

const char* const bashTail = R"sh(    esac
    if [[ $current == -* && $flags ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$flags" -- "$current")
        return
    fi
    case $kind in
        words) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current") ;;
        scene)
            compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(
                compgen -W "$("$program" completion --scenes 2>/dev/null)" -- "$current"
                compgen -f -X '!*.toml' -- "$current"
                compgen -d -- "$current"
            )
            ;;
        file)
            compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -f -- "$current")
            ;;
        folder)
            compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -d -- "$current")
            ;;
    esac
}
complete -F _PROGRAM PROGRAM
)sh";

const char* const zshHead = R"sh(#compdef PROGRAM
_PROGRAM_scenes() {
    local -a names=(${(f)"$(PROGRAM completion --scenes 2>/dev/null)"})
    _alternative 'names:shipped scene:compadd -a names' 'files:scene file:_files -g "*.toml"'
}
_PROGRAM() {
    local context state state_descr line
    local -A opt_args
    local -a commands=(
)sh";

const char* const zshMiddle = R"sh(    case $state in
    command) _describe command commands ;;
    word)
        case $words[1] in
)sh";

const char* const zshTail = R"sh(        esac
        ;;
    esac
}
_PROGRAM "$@"
)sh";

std::string withProgram(std::string text, const std::string& program) {
    constexpr std::string_view place = "PROGRAM";
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + program.size()))
        text.replace(at, place.size(), program);
    return text;
}

// The text in brackets of an argument to zsh's _arguments.
std::string zshHelp(std::string_view text) {
    std::string out;
    for (const char c : text) out += c == '[' || c == ']' ? std::string("\\") + c : std::string(1, c);
    return out;
}

std::string zshValue(const OptionFacts& option) {
    std::string name = option.isPositional() ? option.names.front() : option.value;
    std::replace(name.begin(), name.end(), ':', ' ');
    return fmt::format(":{}:{}", name, withWords(wayOf(option).zsh, option));
}

std::string zshOption(const OptionFacts& option) {
    if (option.isPositional()) return shellWord((option.isRepeatable ? "*" : "") + zshValue(option));
    const bool takesValue = !option.value.empty();
    const std::string tail = fmt::format("[{}]{}", zshHelp(option.help), takesValue ? zshValue(option) : "");
    std::string out;
    for (const std::string& name : option.names) {
        const std::string others = option.isRepeatable ? "*" : fmt::format("({})", fmt::join(option.names, " "));
        const char* const joint = !takesValue ? "" : name.starts_with("--") ? "=" : "+";
        out += (out.empty() ? "" : " ") + shellWord(others + name + joint + tail);
    }
    return out;
}

std::string zshArguments(const CommandFacts& command) {
    std::string out = "_arguments";
    for (const OptionFacts& option : command.options) out += " \\\n        " + zshOption(option);
    return out;
}

// Within single quotes of fish, which knows \' and \\ there.
std::string fishQuoted(std::string_view text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return out + "'";
}

std::string fishOption(const OptionFacts& option, const std::string& condition) {
    std::string out = fmt::format("complete -c PROGRAM -n {}", fishQuoted(condition));
    const Way& way = wayOf(option);
    if (option.isPositional() && &way == &byNothing) return "";
    if (option.isPositional()) return out + (&way == &byFiles ? " -F" : withWords(way.fish, option)) + "\n";
    for (const std::string& name : option.names)
        out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.value.empty()) out += withWords(way.fish, option);
    return out + fmt::format(" -d {}\n", fishQuoted(option.help));
}

}  // namespace

std::string bashCompletion(const CommandTree& tree) {
    std::vector<std::string> names;
    for (const CommandFacts& command : tree.commands) names.push_back(command.name);
    std::string out = withProgram(bashHead, tree.program.name);
    out += fmt::format("        '') flags='{}' kind=words words='{}' ;;\n", bashFlags(tree.program),
                       fmt::join(names, " "));
    for (const CommandFacts& command : tree.commands) out += bashCase(command);
    return out + withProgram(bashTail, tree.program.name);
}

std::string zshCompletion(const CommandTree& tree) {
    std::string out = zshHead;
    for (const CommandFacts& command : tree.commands)
        out += fmt::format("        {}\n", shellWord(command.name + ":" + command.help));
    out +=
        fmt::format("    )\n    {} \\\n        '1:command:->command' '*::word:->word'\n", zshArguments(tree.program));
    out += zshMiddle;
    for (const CommandFacts& command : tree.commands)
        out += fmt::format("        {})\n            {}\n            ;;\n", command.name, zshArguments(command));
    return withProgram(out + zshTail, tree.program.name);
}

std::string fishCompletion(const CommandTree& tree) {
    std::string out = "complete -c PROGRAM -f\n";
    for (const OptionFacts& option : tree.program.options) out += fishOption(option, "__fish_use_subcommand");
    for (const CommandFacts& command : tree.commands) {
        out += fmt::format("complete -c PROGRAM -n __fish_use_subcommand -a {} -d {}\n", command.name,
                           fishQuoted(command.help));
        for (const OptionFacts& option : command.options)
            out += fishOption(option, "__fish_seen_subcommand_from " + command.name);
    }
    return withProgram(out, tree.program.name);
}

}  // namespace taut::game
