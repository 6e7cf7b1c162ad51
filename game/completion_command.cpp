#include "game/completion.h"

#include <fmt/format.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/messages.h"
#include "game/usage.h"

namespace taut::game {
namespace {

struct CompletionFlags {
    std::string shell;
    bool scenes = false;
};

int completion(const CompletionFlags& flags, const CommandTree& tree) {
    if (flags.scenes) {
        std::set<std::string> names;
        for (const std::vector<std::string>& some : {shippedScenes(), shippedScenarios()})
            names.insert(some.begin(), some.end());
        printResult("{}\n", fmt::join(names, "\n"));
        return static_cast<int>(ExitCode::ok);
    }
    if (flags.shell.empty()) failUsage("name a shell: bash, zsh or fish");
    const bool isZsh = flags.shell == "zsh";
    writeResult(isZsh ? zshCompletion(tree) : flags.shell == "fish" ? fishCompletion(tree) : bashCompletion(tree));
    return static_cast<int>(ExitCode::ok);
}

Action declareCompletion(Options& options) {
    const auto flags = std::make_shared<CompletionFlags>();
    options.value("SHELL", flags->shell, "Shell").oneOf({"bash", "zsh", "fish"});
    options.flag("--scenes", flags->scenes, "Print the names of the shipped scenes and scenarios instead");
    options.footer(
        "Examples:\n"
        "  source <(taut completion bash)\n"
        "  taut completion fish > ~/.config/fish/completions/taut.fish");
    return [flags, tree = options.tree()] { return completion(*flags, tree()); };
}

}  // namespace

Command completionCommand() {
    return {"completion", "Print a completion script for a shell", declareCompletion};
}

}  // namespace taut::game
