#include "taut/core/private/child_process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "image_support.h"
#include "support/text.h"

namespace taut::core {
namespace {

ChildCommand shell(const std::string& text) {
    return {{"sh", "-c", text}};
}

TEST(ChildProcess, ReadsWhatIsWrittenAndSaysWhereItSaysIt) {
    // More than a pipe or a socket holds: both sides have to go on.
    const std::string text(1 << 20, 'x');
    const ChildResult result = runChild(shell("wc -c; echo a; echo b >&2; exit 3"), text);
    EXPECT_EQ(result.output, "1048576\na");
    EXPECT_EQ(result.errors, "b");
    EXPECT_EQ(result.end.code, 3);
    EXPECT_EQ(result.end.text(), "failed with exit code 3");
}

TEST(ChildProcess, TellsASignalFromAnExitCode) {
    const ChildEnd end = runChild(shell("kill -9 $$")).end;
    EXPECT_FALSE(end.succeeded());
    EXPECT_EQ(end.text(), "was ended by signal 9");
}

TEST(ChildProcess, HasTheEnvironmentThatTheCommandSays) {
    ::setenv("TAUT_TEST_KEPT", "kept", 1);
    ::setenv("TAUT_TEST_GONE", "there", 1);
    ::setenv("TAUT_TEST_SET", "old", 1);
    ChildCommand command = shell("echo $TAUT_TEST_KEPT ${TAUT_TEST_GONE-lacking} $TAUT_TEST_SET");
    command.environment = {{"TAUT_TEST_GONE", std::nullopt}, {"TAUT_TEST_SET", "a b=c"}};
    EXPECT_EQ(runChild(command).output, "kept lacking a b=c");
    EXPECT_STREQ(std::getenv("TAUT_TEST_SET"), "old");
}

TEST(ChildProcess, ThatCannotBeRunIsAnErrorWithItsName) {
    for (const char* program : {"no-such-program-here", "/no/such/program"}) {
        EXPECT_FALSE(isInPath(program));
        const std::string said = test::messageOf(ErrorKind::inputOutput, [&] { runChild({{program}}); });
        EXPECT_TRUE(test::has(said, std::string("cannot run ") + program + ": No such file")) << said;
    }
    EXPECT_TRUE(isInPath("sh"));
    EXPECT_TRUE(isInPath("/bin/sh"));
}

TEST(ChildProcess, ClosesItsFiles) {
    const auto files = [] {
        const std::filesystem::directory_iterator open("/proc/self/fd");
        return std::distance(begin(open), end(open));
    };
    const auto before = files();
    runChild(shell("exit 0"));
    EXPECT_EQ(files(), before);
}

// A minute of sleep that nobody waits for.
TEST(ChildProcess, EndsWhenItIsStoppedOrForgotten) {
    const std::atomic<bool> stop = true;
    EXPECT_EQ(runChild(shell("exec sleep 60"), {}, &stop).end.signal, SIGKILL);
    const test::TemporaryFolder folder;
    {
        ChildProcess child(shell("echo $$ > " + (folder / "id").string() + "; read line; exec sleep 60"));
        while (test::contentOf(folder / "id").empty()) {
        }
    }
    EXPECT_NE(::kill(std::stoi(test::contentOf(folder / "id")), 0), 0);
}

}  // namespace
}  // namespace taut::core
