// The moments of a check, and the report of one that fails or never had its moment.
#include "taut/check/watcher.h"
#include "unit/check_support.h"

namespace taut::check {
namespace {

// A ball that falls from 10 m in double precision: y = 10 - g t²/2, which leap-frog has exactly.
const std::string falling =
    "[run]\nfps = 30\nseconds = 1\n"
    "[net.ball]\ndrag_per_s = 0\npoints = [{ name = \"p\", position = [0, 10, 0] }]\n";

// Plays `ticks` ticks; 58 is the last that the run shows.
std::vector<Result> watched(const std::string& checks, int ticks = 58) {
    const world::SceneSpec scene = sceneOf(falling + checks);
    world::World world(scene);
    Watcher watcher(scene);
    watcher.look(world);
    for (int i = 0; i < ticks; ++i) {
        play(world, 1);
        watcher.look(world);
    }
    return watcher.results();
}

std::string check(const std::string& that, const std::string& when = "") {
    return "[[check]]\nthat = \"" + that + "\"\n" + when;
}

TEST(CheckWatcher, ACheckThatHoldsTellsHowNearItCame) {
    const Result result = watched(check("height(net.ball) > 5")).at(0);
    EXPECT_TRUE(result.passed) << result.reason;
    EXPECT_EQ(result.span, "always");
    EXPECT_EQ(result.looks, 59);
    EXPECT_EQ(result.failures, 0);
    EXPECT_FALSE(result.first.has_value());
    const double t = 58.0 / 60;
    EXPECT_EQ(result.worst->tick, 58);
    EXPECT_EQ(result.worst->frame, 29);
    EXPECT_NEAR(result.worst->outcome.value, 10 - 9.81 / 2 * t * t, 1e-12);
    EXPECT_EQ(result.reason, "");
}

// 10 - g t²/2 < 9 from t = 0.4515 s on: tick 28 of 60 a second is the first after it.
TEST(CheckWatcher, AFailureSaysWhenWhereTheValueAndTheBound) {
    const Result result = watched(check("height(net.ball) >= 9")).at(0);
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.failures, 58 - 28 + 1);
    EXPECT_EQ(result.first->tick, 28);
    EXPECT_EQ(result.first->frame, 14);
    EXPECT_EQ(result.first->where, "net.ball@#0 at [0, 8.932, 0]");
    EXPECT_EQ(result.worst->tick, 58);
    EXPECT_EQ(result.reason,
              "height(net.ball) is 8.9318 m, not >= 9 m, at 0.466667 s, frame 14, net.ball@#0 at [0, 8.932, 0]");
    EXPECT_EQ(result.source.file, "s.toml");
    EXPECT_EQ(result.source.line, 11);
    EXPECT_EQ(result.source.column, 9);
}

// Spawned at the start of the tick from 0.5 s, far below the one that falls.
TEST(CheckWatcher, ABodyThatComesLaterIsSeenFromThenOn) {
    const Result result =
        watched(
            "[[at]]\nt = 0.5\ndo = \"spawn\"\ntarget = \"net.late\"\n"
            "[net.late]\ndrag_per_s = 0\nhold = [\"p\"]\npoints = [{ name = \"p\", position = [0, 2, 0] }]\n" +
            check("lowest(net.*) > 3"))
            .at(0);
    ASSERT_TRUE(result.first);
    EXPECT_EQ(result.first->tick, 31);
    EXPECT_EQ(result.first->where, "net.late@#0 at [0, 2, 0]");
}

TEST(CheckWatcher, MomentsAndSpansAreTakenToTicks) {
    const std::vector<Result> results =
        watched(check("height(net.ball) < 10", "at = 0.5\n") + check("height(net.ball) < 9.9", "from = 0.25\n") +
                check("height(net.ball) > 8.8", "to = 0.45\n") + check("time >= 0.3", "from = 0.3\nto = 0.4\n"));
    const char* spans[] = {"at 0.5 s", "from 0.25 s on", "up to 0.45 s", "from 0.3 s to 0.4 s"};
    const std::int64_t looks[] = {1, 58 - 15 + 1, 28, 24 - 18 + 1};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(results[i].passed) << results[i].reason;
        EXPECT_EQ(results[i].span, spans[i]);
        EXPECT_EQ(results[i].looks, looks[i]);
    }
}

TEST(CheckWatcher, ACheckWhoseMomentNeverCameHasFailed) {
    const std::vector<Result> results =
        watched(check("time < 9", "at = 0.5\n") + check("time < 9", "from = 0.2\nto = 0.4\n") + check("time < 9"), 20);
    EXPECT_FALSE(results[0].passed);
    EXPECT_EQ(results[0].reason, "its moment, 0.5 s, never came");
    EXPECT_FALSE(results[1].passed);
    EXPECT_EQ(results[1].reason, "the run ended at 0.333333 s, before 0.4 s");
    EXPECT_FALSE(results[2].passed);
    EXPECT_EQ(results[2].reason, "the run ended at 0.333333 s, before 0.966667 s");
}

TEST(CheckWatcher, ChecksWithoutANumberHaveFailed) {
    const Result result = watched(check("(time - time) / (time - time) < 1")).at(0);
    EXPECT_FALSE(result.passed);
    EXPECT_EQ(result.failures, 59);
}

}  // namespace
}  // namespace taut::check
