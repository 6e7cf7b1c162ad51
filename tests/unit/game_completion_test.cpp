// Texts made from the tree of commands: the manual, and the completions of shells.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "image_support.h"
#include "program_support.h"

namespace taut::test::completion {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// The output of a command that a shell runs in this folder; it has to succeed without other output.
std::string printed(const TemporaryFolder& folder, const std::string& command) {
    writeText(folder / "script", "cd '" + (folder / "here").string() + "'\n" + command);
    const std::string base = folder.path().string();
    const std::string line = "bash --norc --noprofile '" + base + "/script' >'" + base + "/out' 2>'" + base + "/err'";
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 0) << command;
    EXPECT_EQ(contentOf(folder / "err"), "") << command;
    return contentOf(folder / "out");
}

// The completions of bash for the last word.
std::vector<std::string> offered(const TemporaryFolder& folder, const std::string& words) {
    const std::string program = "'" TAUT_PROGRAM "'";
    return linesOf(printed(
        folder, "source <(" + program +
                    " completion bash)\n[ \"$(complete -p taut)\" = 'complete -F _taut taut' ] || exit 1\n" +
                    "COMP_WORDS=(" + program + " " + words + ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_taut\n" +
                    "printf '%s\\n' \"${COMPREPLY[@]}\" | sort"));
}

using Words = std::vector<std::string>;

TEST(Completion, BashOffersCommandsFlagsTheirWordsScenesFilesAndFolders) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "here/films");
    writeText(folder / "here/flare.toml", "");
    writeText(folder / "here/flute.txt", "");
    EXPECT_EQ(offered(folder, "re"), (Words{"reality", "record", "render", "replay"}));
    EXPECT_EQ(offered(folder, "render --metr"), (Words{"--metrics", "--metrics-of"}));
    EXPECT_EQ(offered(folder, "render fl"), (Words{"flag", "flare.toml"}));
    EXPECT_EQ(offered(folder, "test torn-"), (Words{"torn-banner"}));
    EXPECT_EQ(offered(folder, "manual many"), (Words{"many-machines"}));
    EXPECT_EQ(offered(folder, "render flag --hash-every ''"), (Words{"frame", "tick"}));
    EXPECT_EQ(offered(folder, "render flag --hash-every = t"), (Words{"tick"}));
    EXPECT_EQ(offered(folder, "render flag -o f"), (Words{"films", "flare.toml", "flute.txt"}));
    EXPECT_EQ(offered(folder, "doctor --output f"), (Words{"films"}));
    EXPECT_EQ(offered(folder, "render flag --frames f"), (Words{""}));
}

TEST(Completion, ShellsKnowEveryCommandAndFlagThatTheHelpNames) {
    const std::regex flag("--[a-z][a-z-]*");
    const std::string bash = run({"completion", "bash"}).out, zsh = run({"completion", "zsh"}).out,
                      fish = run({"completion", "fish"}).out, page = run({"manual"}).out;
    for (const game::Command& command : game::builtInCommands()) {
        const std::string name(command.name), help = run({name, "--help"}).out;
        EXPECT_TRUE(has(bash, "        " + name + ")\n")) << name;
        EXPECT_TRUE(has(zsh, "        " + name + ")\n")) << name;
        EXPECT_TRUE(has(fish, " -a " + name + " ")) << name;
        EXPECT_TRUE(has(page, "\n.SS " + name + "\n")) << name;
        for (const std::string& line : linesOf(help)) {
            std::smatch found;
            if (!line.starts_with("  -") || !std::regex_search(line, found, flag)) continue;
            const std::string bare = found.str().substr(2);
            EXPECT_TRUE(has(bash, "--" + bare)) << bare;
            EXPECT_TRUE(has(zsh, ")--" + bare) || has(zsh, "*--" + bare)) << bare;
            EXPECT_TRUE(has(fish, "from " + name + "' -l " + bare) || has(fish, " -l " + bare + " ")) << bare;
            EXPECT_TRUE(has(page, std::regex_replace("--" + bare, std::regex("-"), "\\-"))) << bare;
        }
    }
    EXPECT_EQ(run({"completion"}).code, 2);
    EXPECT_EQ(run({"completion", "csh"}).code, 2);
}

TEST(Manual, IsAPageThatGroffSetsWithoutAWarning) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "here");
    const std::string page =
        printed(folder, "set -o pipefail\n'" TAUT_PROGRAM "' manual | groff -man -ww -Tutf8 -P -cbou");
    const std::string words = std::regex_replace(page, std::regex("\\s+"), " ");  // however wide it is set
    for (const char* part :
         {" NAME taut - simulates ", " taut render [OPTION ...] SCENE ", " -y, --yes Overwrite existing files. ",
          " Values: frame, tick. ", " EXIT STATUS ", " taut render flag -o flag.mp4 "})
        EXPECT_TRUE(has(words, part)) << part << " in " << page;
}

}  // namespace
}  // namespace taut::test::completion
