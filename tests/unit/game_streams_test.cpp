// Streams that cannot be written and files that may not grow cost no result but their own.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "image_support.h"

namespace taut::game {
namespace {

using test::TemporaryFolder;

// The scene `spring`, a picture of it, and everything else as a shell has it: "taut render … 2>&-".
class Shell {
  public:
    Shell() {
        test::writeText(folder / "spring.toml", R"(schema = 1
[run]
fps = 60
seconds = 0.02
[picture]
size = [64, 48]
samples = 1
shadow_size = 128
[net.spring]
points = [ { name = "nail", position = [0, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0] } ]
springs = [ { a = "nail", b = "bob", stiffness_N_per_m = 100.0 } ]
)");
    }

    int exitCode(const std::string& before, const std::string& arguments) const {
        const int status = std::system(
            ("cd '" + folder.path().string() + "' && " + before + " " TAUT_PROGRAM " " + arguments).c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

    TemporaryFolder folder;
};

TEST(Streams, NotesThatNobodyCanReadCostNoResult) {
    const Shell shell;
    for (const std::string closed : {"2>/dev/full", "2>&-", "2>&- <&-", "2>&1 | head -c 1 >/dev/null; true"}) {
        EXPECT_EQ(shell.exitCode("", "render spring.toml -y -o out --video a.mp4 " + closed), 0) << closed;
        EXPECT_TRUE(std::filesystem::remove(shell.folder / "out/run.json")) << closed;
        EXPECT_TRUE(std::filesystem::remove(shell.folder / "a.mp4")) << closed;
    }
    EXPECT_EQ(shell.exitCode("", "check none.toml 2>&-"), 6);
    EXPECT_EQ(shell.exitCode("", "--no-such 2>/dev/full"), 2);
}

TEST(Streams, ResultsThatNobodyCanReadAreAnErrorAndTheFilesStay) {
    const Shell shell;
    for (const std::string what : {"", "--help", "info spring.toml", "schema", "info --methods --json"})
        for (const std::string lost : {" >/dev/full 2>&-", " >&- 2>/dev/null"})
            EXPECT_EQ(shell.exitCode("", what + lost), 6) << what << lost;
    EXPECT_EQ(shell.exitCode("", "render spring.toml --hash -o out --video a.mp4 2>/dev/null >/dev/full"), 6);
    EXPECT_TRUE(std::filesystem::exists(shell.folder / "out/frame_000000.png"));
    EXPECT_TRUE(std::filesystem::exists(shell.folder / "out/run.json"));
    EXPECT_TRUE(std::filesystem::exists(shell.folder / "a.mp4"));
}

// The schema is longer than a pipe holds (64 kB).
TEST(Streams, AReaderThatHasHadEnoughIsNoError) {
    const Shell shell;
    for (const std::string what : {"schema", "--help", "manual", "completion bash", "info --methods --json"}) {
        EXPECT_EQ(shell.exitCode("(", what + " 2>said; echo $? >code) | head -c 1 >/dev/null"), 0) << what;
        EXPECT_EQ(test::contentOf(shell.folder / "said"), "") << what;
        EXPECT_EQ(test::contentOf(shell.folder / "code"), "0\n") << what;
    }
}

TEST(Streams, AFileThatMayNotGrowIsAnErrorAndLeavesNoHalf) {
    const Shell shell;
    EXPECT_EQ(shell.exitCode("ulimit -f 1;", "render spring.toml -o out 2>said"), 6);
    const std::string said = test::contentOf(shell.folder / "said");
    EXPECT_NE(said.find("make room for it, or write to another disk; the same with --resume then goes on"),
              std::string::npos)
        << said;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shell.folder.path()))
        EXPECT_NE(entry.path().extension(), ".part");
}

TEST(Streams, NamesDoNotSteerTheTerminal) {
    const Shell shell;
    EXPECT_EQ(shell.exitCode("", "check \"$(printf 'a\\033]0;b\\007.toml')\" >said 2>&1"), 6);
    EXPECT_EQ(test::contentOf(shell.folder / "said").find_first_of("\x1b\x07"), std::string::npos);
}

}  // namespace
}  // namespace taut::game
