#include "game/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "taut/core/error.h"
#include "game/commands.h"
#include "game/folders.h"
#include "game/messages.h"
#include "game/suggestion.h"

namespace taut::game {
namespace {

constexpr std::array commands{addRender, addPlay,   addCheck,  addInfo,  addChart,  addAtlas, addPlan,
                              addTest,   addRecord, addReplay, addSheet, addSchema, addDoctor};

int codeOf(core::ExitCode code) {
    return static_cast<int>(code);
}

void printShortHelp() {
    fmt::print(
        "taut plays scenes of ropes, cloth and soft bodies and renders them without a display.\n\n"
        "  taut render flag -o flag.mp4                 a video of a shipped scene\n"
        "  taut render my.toml -o out/frame_######.png  a picture file a frame\n"
        "  taut play curtain                            a window: pull the cloth with the mouse, record what you do\n"
        "  taut info flag                               what a scene builds, its time step and its cost\n"
        "  taut chart cloth-corners                     error against cost of every method, as pictures and CSV\n"
        "  taut check my.toml                           whether a scene file is right\n"
        "  taut test scenarios                          whether scenarios do what their goldens say\n"
        "  taut doctor                                  whether everything needed is installed\n"
        "  taut schema > taut.schema.json               the scene format, for editors\n\n"
        "taut --help lists the commands, taut COMMAND --help their flags.\n");
    const std::vector<std::string> scenes = shippedScenes();
    if (!scenes.empty()) fmt::print("Shipped scenes: {}\n", fmt::join(scenes, ", "));
}

std::vector<std::string> commandNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> flagNames(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
}

// What stood on the command line and means nothing, with what may have been meant.
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

int usageError(const CLI::App& app, const std::string& message) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const std::string command = chosen.empty() ? "taut" : "taut " + chosen.front()->get_name();
    fmt::print(stderr, "taut: {}\nTry {} --help.\n", message, command);
    return codeOf(core::ExitCode::usage);
}

int runAction(const Action& action) {
    try {
        const int code = action();
        // A result that did not reach its reader is a failure.
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            throw core::Error(core::ExitCode::inputOutput, "cannot write to standard output");
        return code;
    } catch (const core::Error& error) {
        printError(error);
        return codeOf(error.code());
    } catch (const std::system_error& error) {  // of files and threads
        fmt::print(stderr, "taut: {}\n", error.what());
        return codeOf(core::ExitCode::inputOutput);
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "taut: there is not enough memory for this\n");
        return codeOf(core::ExitCode::badContent);
    }
}

}  // namespace

int runProgram(int argc, const char* const* argv) {
    CLI::App app{"Plays scenes of ropes, cloth and soft bodies and renders them without a display.", "taut"};
    app.set_version_flag("--version", "taut " TAUT_VERSION);
    app.set_help_flag("-h,--help", "Print this help");
    app.require_subcommand(0, 1);
    app.footer(
        "Exit codes: 0 ok, 1 a check or golden failed, 2 usage, 3 bad content, 4 diverged, 5 need not met,\n"
        "6 input or output, 7 nothing to draw with, 8 golden missing, 130 and 143 interrupted.");
    Action chosen;
    for (const auto add : commands) add(app, chosen);

    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        fmt::print("{}", app.help());
        return codeOf(core::ExitCode::ok);
    } catch (const CLI::CallForVersion& version) {
        fmt::print("{}\n", version.what());
        return codeOf(core::ExitCode::ok);
    } catch (const CLI::ExtrasError&) {
        return usageError(app, unknownWord(app));
    } catch (const CLI::ParseError& error) {
        return usageError(app, error.what());
    }
    if (!chosen) {
        printShortHelp();
        return codeOf(core::ExitCode::ok);
    }
    return runAction(chosen);
}

}  // namespace taut::game
