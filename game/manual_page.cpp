#include "game/manual_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "taut/core/private/utf8.h"

namespace taut::game {
namespace {

// One word or line as it is: characters of the formatter are escaped, and all of it is ASCII.
std::string asWritten(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const core::Letter letter = core::firstLetter(text);
        const std::size_t size = std::max<std::size_t>(letter.size, 1);
        switch (letter.code) {
            case '\\': out += "\\e"; break;
            case '-': out += "\\-"; break;
            case '\'': out += "\\(aq"; break;
            case '`': out += "\\(ga"; break;
            case '^': out += "\\(ha"; break;
            case '~': out += "\\(ti"; break;
            case '"': out += "\\(dq"; break;
            default:
                out += letter.code < 128 ? std::string(text.substr(0, size)) : fmt::format("\\[u{:04X}]", letter.code);
        }
        text.remove_prefix(size);
    }
    return out.starts_with('.') ? "\\&" + out : out;
}

// A paragraph, in lines of the source that editors and mandoc like.
std::string filled(const std::string& text) {
    constexpr std::size_t widest = 78;
    std::istringstream words(text);
    std::string out, line;
    for (std::string word; words >> word;) {
        word = asWritten(word);
        if (!line.empty() && line.size() + 1 + word.size() > widest) {
            out += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return out + line + "\n";
}

std::string unfilled(const std::string& text) {
    std::string out = ".PP\n.nf\n";
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) out += asWritten(line) + "\n";
    return out + ".fi\n";
}

std::string optionText(const OptionFacts& option) {
    std::string out = ".TP\n";
    for (std::size_t i = 0; i < option.names.size(); ++i)
        out += fmt::format("{}\\f{}{}\\fR", i > 0 ? ", " : "", option.isPositional() ? 'I' : 'B',
                           asWritten(option.names[i]));
    if (!option.isPositional() && !option.value.empty()) out += fmt::format(" \\fI{}\\fR", asWritten(option.value));
    std::string help = option.help + ".";
    if (!option.words.empty()) help += fmt::format(" Values: {}.", fmt::join(option.words, ", "));
    if (!option.range.empty()) help += fmt::format(" Range: {}.", option.range);
    if (!option.standard.empty()) help += fmt::format(" Default: {}.", option.standard);
    if (option.isRequired && !option.isPositional()) help += " Required.";
    return out + "\n" + filled(help);
}

std::string optionTexts(const CommandFacts& command) {
    std::string out;
    for (const bool positional : {true, false})
        for (const OptionFacts& option : command.options)
            if (option.isPositional() == positional && option.names.back() != "--help") out += optionText(option);
    return out;
}

std::string synopsis(const CommandFacts& command, const std::string& program) {
    std::string out = fmt::format("\\fB{} {}\\fR [\\fIOPTION\\fR ...]", program, command.name);
    for (const OptionFacts& option : command.options) {
        if (!option.isPositional()) continue;
        const std::string word =
            fmt::format("\\fI{}\\fR{}", asWritten(option.names[0]), option.isRepeatable ? " ..." : "");
        out += option.isRequired ? " " + word : " [" + word + "]";
    }
    return out + "\n";
}

std::string inCapitals(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

}  // namespace

std::string manualPage(const CommandTree& tree, const ManualAbout& about) {
    const std::string& program = tree.program.name;
    std::string help = tree.program.help;
    if (help.ends_with('.')) help.pop_back();
    if (!help.empty()) help.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(help.front())));
    std::string out =
        fmt::format(".TH {} 1 {} \"{}\" \"User Commands\"\n", inCapitals(program), about.date, about.version);
    out += fmt::format(".SH NAME\n{} \\- {}", asWritten(program), filled(help));
    out += ".SH SYNOPSIS\n";
    for (const CommandFacts& command : tree.commands) {
        if (&command != &tree.commands.front()) out += ".br\n";
        out += synopsis(command, program);
    }
    out += ".SH OPTIONS\n" + optionTexts(tree.program);
    out += fmt::format(".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nPrint help; behind a command, that of the command.\n");
    out += ".SH COMMANDS\n";
    for (const CommandFacts& command : tree.commands) {
        out += fmt::format(".SS {}\n", asWritten(command.name)) + synopsis(command, program);
        out += ".PP\n" + filled(command.help + ".") + optionTexts(command);
        if (!command.footer.empty()) out += unfilled(command.footer);
    }
    out += ".SH EXIT STATUS\n" + filled(tree.program.footer);
    return out + about.explanation;
}

}  // namespace taut::game
