#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "image_support.h"
#include "taut/core/private/child_process.h"
#include "taut/image/read.h"

namespace taut::game {
namespace {

using test::TemporaryFolder;

// Starts the program with its results and its messages in a file, and with that file's folder for a core file.
pid_t started(std::vector<std::string> arguments, const std::filesystem::path& messages) {
    arguments.insert(arguments.begin(), TAUT_PROGRAM);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
    posix_spawn_file_actions_addchdir_np(&files, messages.parent_path().c_str());
    rlimit limit{};
    ::getrlimit(RLIMIT_CORE, &limit);
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_CORE, &limit);
    pid_t process = -1;
    EXPECT_EQ(posix_spawn(&process, argv[0], &files, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);
    return process;
}

// Looks now and then; gives up after a time that no working program comes near.
bool comesTrue(const std::function<bool()>& condition) {
    for (int i = 0; i < 30000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

// Keeps the core file that a program has left in a folder, and prints the stacks of its threads.
void showCrash(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!entry.path().filename().string().starts_with("core")) continue;
        const std::string kept = testing::TempDir() + folder.filename().string() + ".core";
        std::filesystem::copy(entry.path(), kept);
        const core::ChildCommand command{{"gdb", "-batch", "-ex", "thread apply all backtrace", TAUT_PROGRAM, kept}};
        ADD_FAILURE() << kept;
        ADD_FAILURE() << core::runChild(command).output;
    }
}

int exitCodeOf(pid_t process, const TemporaryFolder& folder) {
    int status = 0;
    ::waitpid(process, &status, 0);
    if (WIFSIGNALED(status)) showCrash(folder.path());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// More than half a million pictures of a spring in short steps: it ends because it is asked to.
std::filesystem::path endlessScene(const TemporaryFolder& folder) {
    const auto path = folder / "endless.toml";
    test::writeText(path, R"(schema = 1
[run]
fps = 60
seconds = 10000
[solver]
dt = 1e-5
[picture]
size = [64, 48]
samples = 1
shadow_size = 256
[net.spring]
points = [ { name = "nail", position = [0, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0] } ]
springs = [ { a = "nail", b = "bob", stiffness_N_per_m = 100.0 } ]
)");
    return path;
}

TEST(Interrupted, ProgramLeavesWholeFramesAndTheirRecord) {
    const TemporaryFolder folder;
    const pid_t process =
        started({"render", endlessScene(folder).string(), "-o", (folder / "out").string()}, folder / "messages");
    EXPECT_TRUE(comesTrue([&] { return std::filesystem::exists(folder / "out/frame_000003.png"); }));
    ::kill(process, SIGINT);
    EXPECT_EQ(exitCodeOf(process, folder), 130) << test::contentOf(folder / "messages");
    std::size_t pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
        EXPECT_NE(entry.path().extension(), ".part");
        if (entry.path().extension() != ".png") continue;
        EXPECT_EQ(image::readImage(entry.path()).width, 64);
        ++pictures;
    }
    const auto json = nlohmann::json::parse(test::contentOf(folder / "out/run.json"));
    EXPECT_EQ(json["ended"], "interrupted");
    EXPECT_EQ(json["state_hash"].size(), pictures);
}

TEST(Interrupted, ProgramLeavesAWholeVideoWhenTerminated) {
    const TemporaryFolder folder;
    const pid_t process =
        started({"render", endlessScene(folder).string(), "-o", (folder / "a.mp4").string(), "--hash", "--quiet"},
                folder / "messages");
    // The first hashes come out once pictures are on their way to the encoder.
    EXPECT_TRUE(comesTrue([&] { return !test::contentOf(folder / "messages").empty(); }));
    ::kill(process, SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(process, SIGTERM);  // as timeout(1) does: to the process, then to its group
    EXPECT_EQ(exitCodeOf(process, folder), 143) << test::contentOf(folder / "messages");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mp4.part"));
    EXPECT_NE(test::contentOf(folder / "a.mp4").find("moov"), std::string::npos);
}

TEST(Interrupted, TestSaysHowFarItCame) {
    const TemporaryFolder folder;
    const pid_t process =
        started({"test", endlessScene(folder).string(), "-o", (folder / "out").string()}, folder / "messages");
    EXPECT_TRUE(comesTrue([&] { return std::filesystem::exists(folder / "out"); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // the folder is there a little before the first tick
    ::kill(process, SIGINT);
    EXPECT_EQ(exitCodeOf(process, folder), 130);
    const std::string said = test::contentOf(folder / "messages");
    EXPECT_NE(said.find("not finished: interrupted at tick "), std::string::npos) << said;
    EXPECT_EQ(said.find("same, "), std::string::npos) << said;
}

// Half an atlas says nothing: neither files nor folders are left, and it does not look finished.
TEST(Interrupted, AtlasSaysSoAndLeavesNothing) {
    const TemporaryFolder folder;
    const std::filesystem::path out = folder / "made/for/it";
    for (const std::vector<std::string>& what :
         {std::vector<std::string>{"rope", "--seconds", "80000"}, {"--cells", "1001"}}) {
        std::vector<std::string> arguments = {"atlas", "-o", out.string()};
        arguments.insert(arguments.end(), what.begin(), what.end());
        const pid_t process = started(arguments, folder / "messages");
        EXPECT_TRUE(comesTrue([&] { return std::filesystem::exists(out); }));
        ::kill(process, SIGINT);
        EXPECT_EQ(exitCodeOf(process, folder), 130);
        const std::string said = test::contentOf(folder / "messages");
        EXPECT_NE(said.find("interrupted: nothing is written"), std::string::npos) << said;
        EXPECT_EQ(said.find("100 %"), std::string::npos) << said;
        EXPECT_FALSE(std::filesystem::exists(folder / "made"));
        std::filesystem::remove(folder / "messages");
    }
}

}  // namespace
}  // namespace taut::game
