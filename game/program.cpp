#include "game/program.h"

#include <fmt/format.h>

#include <csignal>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "game/command_table.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/messages.h"
#include "game/version.h"
#include "taut/core/error.h"

namespace taut::game {
namespace {

int codeOf(ExitCode code) {
    return static_cast<int>(code);
}

void printShortHelp() {
    printResult(
        "taut simulates ropes, cloth, soft bodies and rigid bodies, and renders them without a display.\n\n"
        "  render   draw a scene as a video, a GIF or pictures   taut render flag -o flag.mp4\n"
        "  play     play it in a window                          taut play curtain\n"
        "  schema   print the scene format                       taut schema --manual\n"
        "  check    validate scene files                         taut check my.toml\n"
        "  info     show statistics, time step and cost          taut info my.toml\n"
        "  test     compare scenarios with goldens               taut test my_scenarios\n\n"
        "taut --help lists all commands, taut COMMAND --help their flags; taut doctor reports missing packages.\n");
    const std::vector<std::string> scenes = shippedScenes();
    if (!scenes.empty()) printResult("Shipped scenes: {}\n", fmt::join(scenes, ", "));
}

// A reader that has gone and a file that may grow no more are errors of the call that wrote, and handled there.
void leaveWriteErrorsToWrite() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGCHLD, SIG_DFL);  // ignored, it would take the exit codes of children
}

int runAction(const Action& action) {
    try {
        return action();
    } catch (const core::Error& error) {
        printError(error);
        return codeOf(exitCodeOf(error.kind()));
    } catch (const CheckFailed& failed) {
        printNote("taut: {}\n", failed.what());
        return codeOf(ExitCode::checkFailed);
    } catch (const std::system_error& error) {  // of files and threads
        if (error.code() != std::errc::resource_unavailable_try_again && error.code() != std::errc::not_enough_memory) {
            printNote("taut: {}\n", error.what());
            return codeOf(ExitCode::inputOutput);
        }
        printNote(
            "taut: not enough memory for a thread: raise the limit (ulimit -v, ulimit -u), or take fewer --threads\n");
    } catch (const std::runtime_error& error) {  // oneTBB throws it for a thread that it cannot start
        if (std::string_view(error.what()).find("pthread_create") == std::string_view::npos) throw;
        printNote(
            "taut: {}: not enough memory for a thread: raise the limit (ulimit -v, ulimit -u), or take fewer "
            "--threads\n",
            error.what());
    } catch (const std::bad_alloc&) {
        printNote("taut: not enough memory: raise the limit (ulimit -v), or take a smaller scene or picture\n");
    }
    return codeOf(ExitCode::noMemory);
}

int runCommandLine(int argc, const char* const* argv, std::span<const Command> commands) {
    CommandLine line(
        {.name = "taut",
         .description = "Simulates ropes, cloth, soft bodies and rigid bodies, and renders them without a display.",
         .version = versionText(),
         .footer = "Exit codes: 0 ok, 1 a check or golden failed, 2 usage, 3 bad content, 4 diverged, 5 need not met,\n"
                   "6 input or output, 7 no renderer or too little memory, 8 golden missing or of other bits, 130 and "
                   "143 interrupted."},
        commands);
    const Request request = line.read(argc, argv);
    switch (request.kind) {
        case Request::Kind::run: return runAction(request.action);
        case Request::Kind::text: printText(request.text); return codeOf(ExitCode::ok);
        case Request::Kind::wrong:
            printNote("taut: {}\nTry {} --help.\n", request.text, request.command);
            return codeOf(ExitCode::usage);
        case Request::Kind::nothing: break;
    }
    printShortHelp();
    return codeOf(ExitCode::ok);
}

}  // namespace

int runProgram(int argc, const char* const* argv, std::span<const Command> commands) {
    const int code = runCommandLine(argc, argv, commands);
    // A result that did not reach its reader is a failure.
    if (areResultsWritten()) return code;
    printNote("taut: cannot write to standard output\n");
    return code == codeOf(ExitCode::ok) ? codeOf(ExitCode::inputOutput) : code;
}

int runProgram(int argc, const char* const* argv) {
    openMissingStreams();
    leaveWriteErrorsToWrite();
    return runProgram(argc, argv, builtInCommands());
}

}  // namespace taut::game
