#include "game/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "game/suggestion.h"
#include "game/usage.h"

#include "taut/core/private/contains.h"

namespace taut::game {
namespace {

std::vector<std::string> commandNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

// All except the removed ones.
std::vector<const CLI::Option*> optionsOf(const CLI::App& command) {
    return command.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::vector<std::string> flagNames(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : optionsOf(command)) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
}

// The unknown words of the command line, with suggestions.
std::string unknownWord(const CLI::App& app) {
    const std::vector<std::string> words = app.remaining(true);
    const std::string word = words.empty() ? "" : words.front();
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    if (word.starts_with('-')) {
        const std::string flag = word.substr(0, word.find('='));
        return fmt::format("unknown flag {}{}", flag,
                           didYouMean(flag, flagNames(chosen.empty() ? app : *chosen.front())));
    }
    if (chosen.empty()) return fmt::format("unknown command '{}'{}", word, didYouMean(word, commandNames(app)));
    return fmt::format("'{}' is one word too many", word);
}

Request wrong(const CLI::App& app, const std::string& message) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
    return {Request::Kind::wrong, {}, message, app.get_name() + command};
}

// "INT:INT in [1 - 9]" and "TEXT:{frame,tick}" are how the library says it.
void addLimits(const std::string& limits, OptionFacts& facts) {
    const std::size_t open = limits.find_first_of("{["), close = limits.find_last_of("}]");
    if (open == std::string::npos || close == std::string::npos) return;
    const std::string inner = limits.substr(open + 1, close - open - 1);
    if (limits[open] == '[')
        facts.range = inner;
    else
        facts.words = CLI::detail::split(inner, ',');
}

OptionFacts factsOf(const CLI::Option& option) {
    OptionFacts facts;
    for (const std::string& name : option.get_snames()) facts.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) facts.names.push_back("--" + name);
    if (facts.names.empty()) facts.names.push_back(option.get_name());
    if (option.get_items_expected_max() > 0) {
        const std::string type = option.get_type_name();
        const std::size_t colon = std::min(type.find(':'), type.size());
        facts.value = type.substr(0, colon);
        addLimits(type.substr(colon), facts);
    }
    facts.standard = option.get_default_str();
    facts.help = option.get_description();
    facts.isRequired = option.get_required();
    facts.isRepeatable = option.get_expected_max() > 1;
    return facts;
}

CommandFacts factsOf(const CLI::App& app) {
    CommandFacts facts{app.get_name(), app.get_description(), app.get_footer(), {}};
    for (const CLI::Option* option : optionsOf(app)) facts.options.push_back(factsOf(*option));
    return facts;
}

}  // namespace

Option Option::required() const {
    option_->required();
    return *this;
}

Option Option::typeName(const std::string& name) const {
    option_->type_name(name);
    return *this;
}

Option Option::showDefault() const {
    option_->capture_default_str();
    return *this;
}

Option Option::separatedBy(char separator) const {
    option_->delimiter(separator);
    return *this;
}

Option Option::oneValue() const {
    option_->allow_extra_args(false);
    return *this;
}

Option Option::mayBeBare() const {
    option_->expected(0, 1);
    return *this;
}

template <class Number>
Option Option::within(Number least, Number most, const std::string& unit) const {
    const CLI::Range range(least, most);
    option_->check(CLI::Validator(
        [range, unit](std::string& text) {
            const std::string fault = range(text);
            return fault.empty() || unit.empty() ? fault : fault + " " + unit;
        },
        range.get_description()));
    return *this;
}
template Option Option::within(int, int, const std::string&) const;
template Option Option::within(std::int64_t, std::int64_t, const std::string&) const;
template Option Option::within(double, double, const std::string&) const;

Option Option::oneOf(const std::vector<std::string>& words) const {
    option_->check(CLI::IsMember(words));
    return *this;
}

Option Option::suggests(const std::vector<std::string>& words) const {
    option_->check(
        CLI::Validator([](std::string&) { return std::string(); }, fmt::format("{{{}}}", fmt::join(words, ","))));
    return *this;
}

Option Option::check(std::function<std::string(const std::string&)> check) const {
    option_->check(std::move(check));
    return *this;
}

Option Option::excludes(const Option& other) const {
    option_->excludes(other.option_);
    return *this;
}

Option Option::each(std::function<void(const std::string&)> take) const {
    option_->each(std::move(take));
    return *this;
}

bool Option::isGiven() const {
    return option_->count() > 0;
}

Option Options::add(CLI::Option* option) const {
    if (!group_.empty()) option->group(group_);
    return Option(option);
}

Option Options::flag(const std::string& names, bool& target, const std::string& help) {
    return add(app_.add_flag(names, target, help));
}

template <class Target>
Option Options::value(const std::string& names, Target& target, const std::string& help) {
    const Option option = add(app_.add_option(names, target, help));
    return option.check([&app = app_](const std::string& text) {  // the library takes any next word
        const std::vector<std::string> flags = flagNames(app);
        return !core::contains(flags, text) ? "" : "its value is missing before " + text;
    });
}
template Option Options::value(const std::string&, std::string&, const std::string&);
template Option Options::value(const std::string&, std::vector<std::string>&, const std::string&);
template Option Options::value(const std::string&, int&, const std::string&);
template Option Options::value(const std::string&, std::int64_t&, const std::string&);
template Option Options::value(const std::string&, double&, const std::string&);
template Option Options::value(const std::string&, std::optional<std::string>&, const std::string&);
template Option Options::value(const std::string&, std::optional<std::int64_t>&, const std::string&);
template Option Options::value(const std::string&, std::optional<double>&, const std::string&);

void Options::gone(const std::string& name, const std::string& instead) {
    const auto refuse = [=](const std::string&) { throw CLI::ValidationError(name, "is gone: " + instead); };
    app_.add_option_function<std::string>(name, refuse)->group("");
}

void Options::footer(const std::string& text) {
    app_.footer(text);
}

std::function<CommandTree()> Options::tree() const {
    return [&root = *app_.get_parent()] {
        CommandTree tree{factsOf(root), {}};
        for (const CLI::App* command : root.get_subcommands([](const CLI::App*) { return true; }))
            tree.commands.push_back(factsOf(*command));
        for (CommandFacts& command : tree.commands)
            if (command.footer == tree.program.footer) command.footer.clear();  // the library hands it down
        return tree;
    };
}

std::function<std::string(const std::string&)> Options::help() const {
    return [&root = *app_.get_parent()](const std::string& name) {
        if (name.empty()) return root.get_formatter()->make_help(&root, root.get_name(), CLI::AppFormatMode::Normal);
        for (CLI::App* command : root.get_subcommands([&](const CLI::App* own) { return own->get_name() == name; }))
            return command->help(root.get_name());
        failUsage("unknown command '{}'{}", name, didYouMean(name, commandNames(root)));
    };
}

struct CommandLine::Impl {
    explicit Impl(const About& about) : app(about.description, about.name) {}
    std::vector<Action> actions;  // hold the targets of the options
    CLI::App app;
    const Action* chosen = nullptr;
};

CommandLine::CommandLine(const About& about, std::span<const Command> commands) : impl_(std::make_unique<Impl>(about)) {
    CLI::App& app = impl_->app;
    app.set_version_flag("-V,--version", about.version, "Print the version");
    app.set_help_flag("-h,--help", "Print this help");
    app.require_subcommand(0, 1);
    app.footer(about.footer);
    impl_->actions.reserve(commands.size());
    for (const Command& command : commands) {
        CLI::App& added = *app.add_subcommand(std::string(command.name), std::string(command.help));
        Options options(added);
        const Action& action = impl_->actions.emplace_back(command.declare(options));
        added.callback([this, &action] { impl_->chosen = &action; });
    }
}

CommandLine::~CommandLine() = default;

Request CommandLine::read(int argc, const char* const* argv) {
    CLI::App& app = impl_->app;
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return {Request::Kind::text, {}, app.help(), {}};
    } catch (const CLI::CallForVersion& version) {
        return {Request::Kind::text, {}, std::string(version.what()) + "\n", {}};
    } catch (const CLI::ExtrasError&) {
        return wrong(app, unknownWord(app));
    } catch (const CLI::ParseError& error) {
        return wrong(app, error.what());
    }
    if (impl_->chosen == nullptr) return {};
    return {Request::Kind::run, *impl_->chosen, {}, {}};
}

}  // namespace taut::game
