// Parts of one run and of one test, drawn and played apart: together they are the result of one process, or the
// missing parts are named.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "game/flags.h"
#include "image_support.h"
#include "program_support.h"
#include "taut/pipeline/run_lock.h"
#include "taut/pipeline/run_parts.h"

namespace taut::test::shards {
namespace {

// A mass on a spring, ten small pictures of it, and a check; drawn beside `shards`, which each of the tests fills.
class Shards : public testing::Test {
  protected:
    void SetUp() override {
        writeText(folder_ / "spring.toml", R"(schema = 1
[run]
fps = 20
seconds = 0.5
[picture]
size = [32, 24]
samples = 1
shadow_size = 128
[net.spring]
points = [ { name = "nail", position = [0, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0] } ]
springs = [ { a = "nail", b = "bob", stiffness_N_per_m = 100.0 } ]
)");
    }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    Outcome render(std::vector<std::string> more) const {
        more.insert(more.begin(), {"render", path("spring.toml"), "--quiet"});
        return run(more);
    }
    void draw(std::vector<std::string> more) const {
        const Outcome outcome = render(std::move(more));
        ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
    void drawShards(int count, const std::vector<std::string>& more = {}) const {
        for (int i = 0; i < count; ++i) {
            std::vector<std::string> all = {"-o", path("shards"), "--shard",
                                            std::to_string(i) + "/" + std::to_string(count)};
            all.insert(all.end(), more.begin(), more.end());
            draw(all);
        }
    }
    std::string frame(const std::string& place, int number) const {
        return contentOf(folder_ / place / ("frame_00000" + std::to_string(number) + ".png"));
    }
    std::size_t filesIn(const std::string& place) const {
        std::size_t files = 0;
        for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_ / place)) ++files;
        return files;
    }

    TemporaryFolder folder_;
};

TEST_F(Shards, JoinedAreTheBytesOfOneRun) {
    // Figures that the states know nothing of.
    draw({"-o", path("one"), "--video", path("one.mp4"), "--metrics-of", "speed(net.spring@bob)", "--overlay",
          "--depth", "--flow"});
    draw({"--no-pictures", "--checkpoint-every", "2", "--checkpoints", path("states")});
    const std::vector<std::string> flags = {"--checkpoints",         path("states"), "--resume", "--metrics-of",
                                            "speed(net.spring@bob)", "--overlay",    "--depth",  "--flow"};
    drawShards(3, flags);
    for (const auto& file : std::filesystem::directory_iterator(folder_ / "one"))
        if (const std::filesystem::path name = file.path().filename(); name.extension() == ".png")
            EXPECT_EQ(contentOf(folder_ / "shards" / name), contentOf(file.path())) << name;
    const Outcome joined = run({"join", path("shards"), "-o", path("joined.mp4"), "--quiet"});
    EXPECT_EQ(joined.code, 0) << joined.err;
    EXPECT_EQ(contentOf(folder_ / "joined.mp4"), contentOf(folder_ / "one.mp4"));
    EXPECT_EQ(contentOf(folder_ / "joined.metrics.csv"), contentOf(folder_ / "one/metrics.csv"));
    // The frames of one process are a run of one part.
    EXPECT_EQ(run({"join", path("one")}).out, path("one") + ": frames 0-9 of one run, in 1 part\n");
    EXPECT_EQ(run({"join", path("shards"), "--threads", "1"}).out,
              path("shards") + ": frames 0-9 of one run, in 3 parts\n");
}

TEST_F(Shards, AreWhatIsSaidToWhoAsksForJobs) {
    const Outcome outcome = render({"-o", path("one"), "--jobs", "3"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(has(outcome.err, "--jobs: is gone: ") && has(outcome.err, "--shard $k/4")) << outcome.err;
    EXPECT_FALSE(has(run({"render", "--help"}).out, "--jobs"));
    EXPECT_EQ(folder_.entryCount(), 1);
}

TEST_F(Shards, MissingFramesAreNamed) {
    drawShards(3);
    std::filesystem::remove(folder_ / "shards/frame_000004.png");
    std::filesystem::remove(folder_ / "shards/run_0-2.json");
    const std::filesystem::path last = folder_ / "shards/run_6-9.json";
    writeText(last, std::regex_replace(contentOf(last), std::regex("\"complete\""), "\"begun\""));
    const Outcome outcome = run({"join", path("shards"), "-o", path("joined.mp4")});
    EXPECT_EQ(outcome.code, 6);
    for (const char* part : {"frames 0-2, 6-9: no record of a part that has drawn them",
                             "run_6-9.json: has started and not ended", "frame 4: no picture", "--resume"})
        EXPECT_TRUE(has(outcome.err, part)) << part << " in " << outcome.err;
    EXPECT_EQ(folder_.entryCount(), 2) << "nothing was begun";
    EXPECT_EQ(run({"join", path("nowhere")}).code, 6);
    EXPECT_EQ(run({"join", path("shards/f_###.png")}).code, 6) << "files of other names";
    // Started again, each draws its missing frames, and the complete one nothing.
    const auto drawn = std::filesystem::last_write_time(folder_ / "shards/frame_000003.png");
    EXPECT_EQ(render({"-o", path("shards"), "--shard", "0/3", "--resume"}).code, 6) << "of which run are its frames?";
    draw({"-o", path("shards"), "--shard", "0/3", "--resume", "-y"});
    draw({"-o", path("shards"), "--shard", "1/3", "--resume"});
    EXPECT_TRUE(has(render({"-o", path("shards"), "--shard", "1/3", "--resume"}).err, "are there already"));
    draw({"-o", path("shards"), "--shard", "2/3", "--resume"});
    EXPECT_EQ(std::filesystem::last_write_time(folder_ / "shards/frame_000003.png"), drawn);
    EXPECT_EQ(run({"join", path("shards")}).code, 0);
}

TEST_F(Shards, OfTwoScenesAreNotJoined) {
    draw({"-o", path("shards"), "--shard", "0/2"});
    const std::string before = frame("shards", 1);
    const Outcome refused = render({"-o", path("shards"), "--shard", "1/2", "--set", "world.gravity=[0,-9,0]"});
    EXPECT_EQ(refused.code, 6);
    EXPECT_TRUE(has(refused.err, "run_0-4.json is of another run")) << refused.err;
    EXPECT_EQ(filesIn("shards"), 6U) << "five frames and their record, as before";
    draw({"-o", path("others"), "--shard", "1/2", "--set", "world.gravity=[0,-9,0]"});
    std::filesystem::copy(folder_ / "others", folder_ / "shards");
    const Outcome joined = run({"join", path("shards"), "-o", path("joined.mp4")});
    EXPECT_EQ(joined.code, 6);
    EXPECT_TRUE(has(joined.err, "run_0-4.json and run_5-9.json are not parts of one run: other settings"))
        << joined.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "joined.mp4"));
    EXPECT_EQ(frame("shards", 1), before);
}

TEST_F(Shards, OfARunThatFailedBeforeItsFirstPictureAreNone) {
    const std::filesystem::path failed = folder_ / "shards/run_5-9.json";
    draw({"-o", path("shards"), "--shard", "1/2", "--set", "world.gravity=[0,-9,0]"});
    writeText(failed, std::regex_replace(contentOf(failed), std::regex("\"complete\""), "\"begun\""));
    const std::string record = contentOf(failed);
    EXPECT_EQ(render({"-o", path("shards"), "--shard", "0/2"}).code, 6) << "it has left pictures";
    for (int i = 5; i < 10; ++i)
        std::filesystem::remove(folder_ / "shards" / ("frame_00000" + std::to_string(i) + ".png"));
    draw({"-o", path("shards"), "--shard", "0/2"});
    EXPECT_FALSE(std::filesystem::exists(failed));
    draw({"-o", path("shards"), "--shard", "1/2"});
    writeText(folder_ / "shards/run_5-8.json", record);
    EXPECT_EQ(run({"join", path("shards")}).code, 0);
}

TEST_F(Shards, OfRunsOfOtherLengthsAreRefused) {
    draw({"-o", path("shards"), "--shard", "0/2"});
    const Outcome longer = render({"-o", path("shards"), "--shard", "1/2", "--seconds", "1", "--resume"});
    EXPECT_EQ(longer.code, 6);
    EXPECT_TRUE(has(longer.err, "run_0-4.json is of a run of 10 frames, and this one has 20")) << longer.err;
    EXPECT_EQ(filesIn("shards"), 6U);
}

TEST_F(Shards, ThatAreDamagedAreDrawnAgain) {
    drawShards(2);
    const std::filesystem::path damaged = folder_ / "shards/frame_000007.png";
    const std::string whole = contentOf(damaged);
    writeText(damaged, whole.substr(0, whole.size() / 2));
    const Outcome joined = run({"join", path("shards"), "-o", path("joined.mp4"), "--quiet"});
    EXPECT_EQ(joined.code, 6);
    for (const char* part : {"frame_000007.png", "The same --shard K/N --resume draws them again"})
        EXPECT_TRUE(has(joined.err, part)) << joined.err;
    draw({"-o", path("shards"), "--shard", "1/2", "--resume"});
    EXPECT_EQ(contentOf(damaged), whole);
}

// Whole pictures of the right size each time; the checksums know the files beside them too.
TEST_F(Shards, ThatChangedPlacesOrAreOfAnotherRunAreNamedAndDrawnAgain) {
    drawShards(2, {"--depth"});
    draw({"-o", path("others"), "--depth", "--set", "world.gravity=[0,-5,0]"});
    const auto refused = [&](const std::string& names) {
        const Outcome joined = run({"join", path("shards")});
        EXPECT_EQ(joined.code, 6);
        EXPECT_TRUE(has(joined.err, "damaged, replaced or moved: " + names + "\n")) << joined.err;
    };
    const std::filesystem::path shards = folder_ / "shards", third = shards / "frame_000003.png";
    const std::string whole = contentOf(third);
    std::filesystem::rename(third, shards / "kept");
    std::filesystem::rename(shards / "frame_000006.png", third);
    std::filesystem::rename(shards / "kept", shards / "frame_000006.png");
    refused("frame_000003.png, frame_000006.png");
    // The part draws its own again, even if only another of them was taken away.
    std::filesystem::remove(shards / "frame_000004.png");
    draw({"-o", path("shards"), "--depth", "--shard", "0/2", "--resume"});
    EXPECT_EQ(contentOf(third), whole);
    refused("frame_000006.png");
    draw({"-o", path("shards"), "--depth", "--frames", "6", "-y"});
    EXPECT_EQ(run({"join", path("shards")}).code, 0);
    std::filesystem::copy_file(folder_ / "others/frame_000007.png", shards / "frame_000007.png",
                               std::filesystem::copy_options::overwrite_existing);
    const std::filesystem::path depth = shards / "frame_000008.depth.png";
    writeText(depth, contentOf(depth) + "more");
    refused("frame_000007.png, frame_000008.png");
}

TEST_F(Shards, OfOtherNamesAreNamed) {
    draw({"-o", path("shards/p_######.png"), "--shard", "0/10"});
    const Outcome joined = run({"join", path("shards")});
    EXPECT_EQ(joined.code, 6);
    EXPECT_TRUE(has(joined.err, "taut join " + path("shards/p_######.png"))) << joined.err;
}

TEST_F(Shards, WithoutAllMetricsAreJoinedWithANote) {
    draw({"-o", path("shards"), "--shard", "0/2", "--metrics"});
    draw({"-o", path("shards"), "--shard", "1/2"});
    const Outcome joined = run({"join", path("shards"), "-o", path("joined.mp4"), "--quiet"});
    EXPECT_EQ(joined.code, 0);
    EXPECT_TRUE(has(joined.err, "metrics_0-4.csv is there, and no metrics_5-9.csv")) << joined.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "joined.metrics.csv"));
}

TEST_F(Shards, ThatAreNotThereAreUsageErrors) {
    for (const auto& [shard, words] : {std::pair("3/3", "they count from 0/3 to 2/3"),
                                       {"0/0", "1 to 1000000"},
                                       {"-1/3", "like 0/8"},
                                       {"1", "like 0/8"},
                                       {"0/11", "10 frames cannot"}}) {
        const Outcome outcome = render({"-o", path("shards"), std::string("--shard=") + shard});
        EXPECT_EQ(outcome.code, 2) << shard;
        EXPECT_TRUE(has(outcome.err, words)) << outcome.err;
    }
    const Outcome video = render({"-o", path("a.mp4"), "--shard", "0/2"});
    EXPECT_EQ(video.code, 2);
    EXPECT_TRUE(has(video.err, "taut join FOLDER -o " + path("a.mp4"))) << video.err;
    const Outcome states = render({"-o", path("shards"), "--shard", "0/2", "--checkpoints", path("nowhere")});
    EXPECT_EQ(states.code, 6);
    EXPECT_TRUE(has(states.err, "--checkpoint-every 60 --checkpoints " + path("nowhere"))) << states.err;
    EXPECT_EQ(folder_.entryCount(), 1);
}

TEST_F(Shards, AreDrawnByOneAtATime) {
    drawShards(2);
    const std::uint64_t key = std::stoull(pipeline::readPartRecord(folder_ / "shards/run_0-4.json").key, nullptr, 16);
    const pipeline::RunLock run(folder_ / "shards", {key, "the run"});
    const pipeline::RunLock part(folder_ / "shards", {std::nullopt, "another host"}, "0-4");
    draw({"-o", path("shards"), "--shard", "1/2", "-y"});
    const Outcome same = render({"-o", path("shards"), "--shard", "0/2", "-y"});
    EXPECT_EQ(same.code, 6);
    EXPECT_TRUE(has(same.err, "0-4 is being written by another process (another host)")) << same.err;
    EXPECT_EQ(render({"-o", path("shards"), "--shard", "1/2", "-y", "--size", "16x16"}).code, 6) << "another run";
}

// The state of a frame holds all before: two that agree in their last common one agree in all.
TEST(RunParts, DifferInTheFirstStateThatDoes) {
    pipeline::PartRecord a;
    a.key = "0123";
    a.hashes = {1, 2, 3, 4};
    pipeline::PartRecord b = a;
    b.hashes = {1, 2, 3, 4, 5, 6};
    EXPECT_EQ(pipeline::differenceOf(a, b), "");
    EXPECT_EQ(pipeline::differenceOf(b, a), "");
    b.hashes[2] = 7;
    EXPECT_EQ(pipeline::differenceOf(a, b), "other states from frame 2 on");
    b = a;
    b.renderer = "softpipe";
    EXPECT_EQ(pipeline::differenceOf(a, b), "drawn by  and by softpipe");
    b = a;
    b.program = "taut 9";
    EXPECT_EQ(pipeline::differenceOf(a, b), "drawn by  and by taut 9");
}

TEST(RunParts, PiecesFollowEachOtherAndDifferByOneAtMost) {
    for (const std::int64_t things : {1, 7, 10, 480})
        for (std::int64_t count = 1; count <= std::min<std::int64_t>(things, 9); ++count) {
            std::int64_t next = 0;
            for (std::int64_t i = 0; i < count; ++i) {
                const game::Shard piece{i, count};
                EXPECT_EQ(piece.begin(things), next);
                next = piece.end(things);
                EXPECT_GE(next - piece.begin(things), things / count);
                EXPECT_LE(next - piece.begin(things), (things + count - 1) / count);
            }
            EXPECT_EQ(next, things);
        }
}

// Scenarios of taut test, one of which fails.
TEST_F(Shards, OfATestBecomeItsReport) {
    std::filesystem::create_directory(folder_ / "my");
    for (const auto& [name, bound] : {std::pair("a", "10"), {"b", "1e-9"}, {"c", "10"}})
        writeText(
            folder_ / "my" / (std::string(name) + ".toml"),
            contentOf(folder_ / "spring.toml") + "[[check]]\nthat = \"max_strain(net.spring) < " + bound + "\"\n");
    const auto test = [&](const std::string& place, std::vector<std::string> more) {
        more.insert(more.begin(), {"test", path("my"), "--quiet", "-o", path(place)});
        return run(more);
    };
    EXPECT_EQ(test("one", {"--junit", path("one.xml")}).code, 1);
    EXPECT_EQ(test("shards", {"--shard", "0/2"}).code, 0) << "a and c";
    const Outcome missing = run({"join", path("shards")});
    EXPECT_EQ(missing.code, 6);
    EXPECT_TRUE(has(missing.err, "shard 1/2 is missing")) << missing.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "shards/report.html"));
    EXPECT_EQ(test("shards", {"--shard", "1/2"}).code, 1) << "b";
    const Outcome again = test("shards", {"--shard", "1/2", "--resume"});
    EXPECT_TRUE(has(again.err, "there already")) << again.err;
    EXPECT_EQ(again.code, 1) << "as it was stored";
    const Outcome joined = run({"join", path("shards"), "--junit", path("joined.xml")});
    EXPECT_EQ(joined.code, 1) << joined.err;
    const auto timeless = [&](const std::string& name) {
        return std::regex_replace(contentOf(folder_ / name), std::regex("time=\"[0-9.]*\"|[0-9.]+ s<"), "");
    };
    EXPECT_EQ(timeless("joined.xml"), timeless("one.xml"));
    EXPECT_EQ(timeless("shards/report.html"), timeless("one/report.html"));
    EXPECT_EQ(test("shards", {"--shard", "0/4"}).code, 2) << "there are three";
    std::filesystem::copy(folder_ / "shards/shard_0-of-2.taut", folder_ / "shards/shard_7-of-2.taut");
    EXPECT_TRUE(has(run({"join", path("shards")}).err, "shard_7-of-2.taut holds shard 0/2, and so does"));
    std::filesystem::remove(folder_ / "shards/shard_7-of-2.taut");
    test("shards", {"--shard", "0/3"});
    EXPECT_EQ(run({"join", path("shards")}).code, 6) << "shards of two runs";
}

// Of files of the same content that cannot be read, wherever they lie; while one plays, no other run writes there.
TEST_F(Shards, OfATestAreOfTheSameFilesInAnyFolder) {
    for (const char* place : {"my", "mine"}) {
        std::filesystem::create_directory(folder_ / place);
        std::filesystem::copy(folder_ / "spring.toml", folder_ / place / "a.toml");
        writeText(folder_ / place / "b.toml", "schema = 1\nnonsense = 1\n");
    }
    EXPECT_EQ(run({"test", path("my"), "--quiet", "-o", path("shards"), "--shard", "0/2"}).code, 8) << "no golden";
    EXPECT_EQ(run({"test", path("mine"), "--quiet", "-o", path("shards"), "--shard", "1/2"}).code, 3);
    EXPECT_EQ(run({"join", path("shards")}).code, 3);
    const pipeline::RunLock shard(folder_ / "shards", {1, "a shard"});
    const Outcome whole = run({"test", path("my"), "--quiet", "-o", path("shards")});
    EXPECT_EQ(whole.code, 6);
    EXPECT_TRUE(has(whole.err, "another run is writing here (a shard)")) << whole.err;
}

}  // namespace
}  // namespace taut::test::shards
