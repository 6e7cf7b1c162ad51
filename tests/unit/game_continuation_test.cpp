// Going on from a stored state: the same states as without a stop, and never from a state of another scene.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "taut/pipeline/checkpoint.h"
#include "taut/world/result_bits.h"
#include "tests/unit/program_support.h"

namespace taut::game::game_continuation {
namespace {

using test::has;
using test::Outcome;

const std::string scene = R"(schema = 1
run = { fps = 60, seconds = 0.5 }
at = [ { t = 0.1, do = "push", target = "cloth.sheet@bottom", impulse_Ns = [0, 0, 0.02] },
       { t = 0.4, do = "free", target = "cloth.sheet@top-left" } ]
[material.linen]
[cloth.sheet]
cells = [5, 5]
material = "linen"
hold = ["top-left", "top-right"]
[collider.ground]
shape = "plane"
normal = [0, 1, 0]
)";

class Continuation : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::path(testing::TempDir()) / "taut_continuation" /
                  testing::UnitTest::GetInstance()->current_test_info()->name();
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
        write(scene);
        whole_ = play({"--checkpoint-every", "10"});
        ASSERT_EQ(whole_.code, 0) << whole_.err;
    }

    void write(const std::string& text) { std::ofstream(folder_ / "scene.toml") << text; }

    Outcome play(std::vector<std::string> more) {
        std::vector<std::string> all = {
            "render",         (folder_ / "scene.toml").string(), "--no-pictures", "--hash", "--quiet", "--checkpoints",
            states().string()};
        all.insert(all.end(), more.begin(), more.end());
        return test::run(all);
    }
    std::filesystem::path states() const { return folder_ / "states"; }
    std::filesystem::path state(const char* number) const {
        return states() / (std::string("checkpoint_") + number + ".taut");
    }

    // The lines of frames `first` and later.
    static std::string from(const std::string& hashes, int first) {
        return hashes.substr(hashes.find("\n" + std::to_string(first) + " ") + 1);
    }

    std::filesystem::path folder_;
    Outcome whole_;
};

TEST_F(Continuation, GivesTheStatesOfARunThatNeverStopped) {
    EXPECT_TRUE(std::filesystem::exists(state("000010")));
    EXPECT_TRUE(std::filesystem::exists(state("000020")));
    const Outcome rest = play({"--from", "25"});
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_TRUE(has(rest.err, "continuing with frame 20")) << rest.err;
    EXPECT_EQ(rest.out, from(whole_.out, 25));
    EXPECT_EQ(play({"--from", "10"}).out, from(whole_.out, 10));
}

// The action at 0.4 s is frame 24's: frame 20 does not know of it, and the step is that of either scene.
TEST_F(Continuation, ReusesWhatIsBeforeAChangeOfTheTimeline) {
    std::string changed = scene;
    changed.replace(changed.find("t = 0.4"), 7, "t = 0.45");
    write(changed);
    const Outcome rest = play({"--from", "20"});
    EXPECT_TRUE(has(rest.err, "continuing with frame 20")) << rest.err;
    EXPECT_NE(rest.out, from(whole_.out, 20));
    EXPECT_TRUE(has(play({"--from", "29", "--set", "world.gravity=[0,-9,0]"}).err, "scene.toml has changed"));
    std::filesystem::remove_all(states());
    EXPECT_EQ(rest.out, play({"--from", "20"}).out) << "as computed from the start";
}

TEST_F(Continuation, DoesNotGoOnFromAnotherScene) {
    for (const char* change :
         {"world.gravity=[0,-9,0]", "cloth.sheet.cells=[5,6]", "solver.integrator=rk4", "at.0.t=0.12"}) {
        const Outcome rest = play({"--from", "29", "--set", change});
        EXPECT_EQ(rest.code, 0) << rest.err;
        EXPECT_TRUE(has(rest.err, "checkpoint_000020.taut: this checkpoint is of another scene")) << change << rest.err;
        EXPECT_TRUE(has(rest.err, "with frame 0")) << change;
    }
}

TEST_F(Continuation, PassesOverADamagedState) {
    std::filesystem::resize_file(state("000020"), std::filesystem::file_size(state("000020")) - 5);
    const Outcome rest = play({"--from", "20"});
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_TRUE(has(rest.err, "checkpoint_000020.taut: this checkpoint is damaged or cut short")) << rest.err;
    EXPECT_TRUE(has(rest.err, "continuing with frame 10")) << rest.err;
    EXPECT_EQ(rest.out, from(whole_.out, 20));

    std::fstream file(state("000010"), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(8);
    file.put(9);  // the version
    file.close();
    const Outcome again = play({"--from", "20"});
    EXPECT_TRUE(has(again.err, "format 9, and this taut reads format 3: it was written by a newer one")) << again.err;
    EXPECT_EQ(again.out, from(whole_.out, 20));
}

// Those after it are of other bits: none of them goes with the frames before.
TEST_F(Continuation, RefusesStatesOfOtherBitsByName) {
    constexpr std::uint64_t most = std::uint64_t{1} << 30U;  // [bytes]
    for (const char* number : {"000000", "000010", "000020"}) {
        pipeline::Checkpoint checkpoint = pipeline::readCheckpoint(state(number), most);
        ++checkpoint.bits;
        pipeline::writeCheckpoint(state(number), checkpoint);
    }
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"--from", "25"}, {"--from", "25", "-y"}, {"--resume"}}) {
        const Outcome refused = play(command);
        EXPECT_EQ(refused.code, 6);
        EXPECT_TRUE(has(refused.err, "0.taut: this checkpoint was " + world::recordedBy(world::resultBits + 1)))
            << refused.err;
        EXPECT_TRUE(has(refused.err, "-y draws all frames again")) << refused.err;
    }
    const Outcome anew = play({"--resume", "-y"});
    EXPECT_EQ(anew.code, 0) << anew.err;
    EXPECT_EQ(anew.out, whole_.out);
}

// Pictures of another scene are not replaced unasked.
TEST_F(Continuation, ResumingKeepsThePicturesOfAnotherScene) {
    const std::filesystem::path frames = folder_ / "frames";
    std::filesystem::create_directories(frames);
    std::ofstream(frames / "frame_000000.png") << "a picture";
    const std::vector<std::string> command = {
        "render", (folder_ / "scene.toml").string(), "-o", frames.string(), "--quiet", "--resume"};
    const Outcome refused = test::run(command);
    EXPECT_EQ(refused.code, 6);
    EXPECT_TRUE(has(refused.err, "-y draws all of them again")) << refused.err;
    std::vector<std::string> never = command;
    never.emplace_back("-n");
    EXPECT_EQ(test::run(never).code, 2);
}

// As a supervisor repeats it: killed at any time, also before the first state but that of the start.
TEST_F(Continuation, ResumesWhatWasKilledBeforeItsFirstState) {
    const std::filesystem::path frames = folder_ / "frames";
    const std::vector<std::string> command = {"render",
                                              (folder_ / "scene.toml").string(),
                                              "-o",
                                              frames.string(),
                                              "--quiet",
                                              "--checkpoint-every",
                                              "20",
                                              "--set",
                                              "picture.size=[16,16]",
                                              "--set",
                                              "picture.samples=1",
                                              "--set",
                                              "picture.shadow_size=128",
                                              "--resume"};
    EXPECT_EQ(test::run(command).code, 0);
    for (const char* number : {"000020", "000029"})
        for (const auto& lost : {frames / "checkpoints" / (std::string("checkpoint_") + number + ".taut"),
                                 frames / (std::string("frame_") + number + ".png")})
            std::filesystem::remove(lost);
    const Outcome again = test::run(command);
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_TRUE(has(again.err, "continuing with frame 0")) << again.err;
    std::vector<std::string> other = command;
    other.insert(other.end(), {"--set", "cloth.sheet.cells=[5,6]"});
    EXPECT_EQ(test::run(other).code, 6) << "other pictures are not drawn over";
}

TEST_F(Continuation, ARepeatedRunDoesNotTakeTheStatesOfTheLast) {
    const Outcome again = play({"--checkpoint-every", "10"});
    EXPECT_EQ(again.code, 6);
    EXPECT_TRUE(has(again.err, "holds states of an earlier run; --resume continues")) << again.err;
    EXPECT_TRUE(has(play({"--from", "25"}).err, "continuing with frame 20"));
    EXPECT_EQ(play({"--checkpoint-every", "10", "-y"}).out, whole_.out);
}

TEST_F(Continuation, SaysWhatCannotBe) {
    EXPECT_EQ(play({"--from", "30"}).code, 2) << "the scene ends with frame 29";
    EXPECT_EQ(play({"--from", "3", "--frames", "3-4"}).code, 2);
    const Outcome video =
        test::run({"render", (folder_ / "scene.toml").string(), "-o", (folder_ / "a.mp4").string(), "--resume"});
    EXPECT_EQ(video.code, 2);
    EXPECT_TRUE(has(video.err, "a video cannot be continued")) << video.err;
    const Outcome nowhere =
        test::run({"render", (folder_ / "scene.toml").string(), "--no-pictures", "--checkpoint-every", "5"});
    EXPECT_EQ(nowhere.code, 2);
    EXPECT_TRUE(has(nowhere.err, "--checkpoints FOLDER")) << nowhere.err;
    std::ofstream(folder_ / "file") << "no folder";
    const Outcome unwritable = test::run({"render", (folder_ / "scene.toml").string(), "--no-pictures",
                                          "--checkpoint-every", "5", "--checkpoints", (folder_ / "file").string()});
    EXPECT_EQ(unwritable.code, 6) << unwritable.err;
}

// A later scene without the cause of the state, in another folder of the same tree. Frame 14 is at tick 14, where the
// state was kept.
TEST_F(Continuation, StartsWhereAnotherRunHasKeptItsState) {
    const std::string kept = (folder_ / "kept.state").string(), later = (folder_ / "later.toml").string();
    const Outcome dressing = test::run({"render", (folder_ / "scene.toml").string(), "--no-pictures", "--quiet",
                                        "--seconds", "0.25", "--keep-state", kept});
    ASSERT_EQ(dressing.code, 0) << dressing.err;
    std::string text = scene;
    const std::size_t push = text.find("{ t = 0.1"), free = text.find("{ t = 0.4");
    text.erase(push, free - push);
    text.replace(text.find("seconds = 0.5"), 13, "seconds = 0.5, start = \"kept.state\"");
    std::ofstream(later) << text;
    const auto run = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"render", later, "--no-pictures", "--hash", "--quiet"};
        all.insert(all.end(), more.begin(), more.end());
        return test::run(all);
    };
    EXPECT_EQ(run({}).out, from(whole_.out, 14));
    EXPECT_EQ(run({"--frames", "20-"}).out, from(whole_.out, 20));
    const Outcome early = run({"--frames", "3-"});
    EXPECT_EQ(early.code, 2);
    EXPECT_TRUE(has(early.err, "--frames 3-: the scene starts with frame 14, from " + kept)) << early.err;
    // It keeps states of its own, and tapes have the ticks that they are of.
    const std::string states = (folder_ / "later").string();
    EXPECT_EQ(run({"--checkpoint-every", "10", "--checkpoints", states}).code, 0);
    const Outcome rest = run({"--from", "25", "--checkpoints", states});
    EXPECT_TRUE(has(rest.err, "continuing with frame 20")) << rest.err;
    EXPECT_EQ(rest.out, from(whole_.out, 25));
    const std::string tape = (folder_ / "later.tape").string();
    EXPECT_TRUE(has(test::run({"record", later, "-o", tape, "--quiet"}).out, "29 ticks"));
    EXPECT_EQ(test::run({"replay", tape, "--verify", "--quiet"}).code, 0);
    // Another state of the same name is another start.
    EXPECT_EQ(test::run({"render", (folder_ / "scene.toml").string(), "--no-pictures", "--quiet", "--seconds", "0.2",
                         "--keep-state", kept, "-y"})
                  .code,
              0);
    EXPECT_TRUE(has(run({"--from", "29", "--checkpoints", states}).err, "kept.state has changed"));
    const Outcome other = test::run({"replay", tape, "--verify", "--quiet"});
    EXPECT_EQ(other.code, 1);
    EXPECT_TRUE(has(other.err, "kept.state has changed since this tape was recorded")) << other.err;
}

}  // namespace
}  // namespace taut::game::game_continuation
