#include "taut/pipeline/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "taut/bodies/net.h"
#include "taut/core/error.h"
#include "taut/forces/wind.h"
#include "taut/pipeline/run_record.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

namespace taut::pipeline {
namespace {

// A mass that hangs on a spring and swings: ω = √(k/m) = 10 / s.
world::SceneSpec pendulum() {
    world::SceneSpec spec;
    spec.file = "pendulum.toml";
    spec.run = {.fps = 30.0, .seconds = 1.0};
    world::NetSpec net;
    net.name = "pendulum";
    net.points.resize(2);
    net.points[0].name = "nail";
    net.points[0].hold = true;
    net.points[1].name = "bob";
    net.points[1].position = {0.5, -1.0, 0.0};
    net.springs.resize(1);
    net.springs[0].a = "nail";
    net.springs[0].b = "bob";
    net.springs[0].stiffness = 100.0;
    spec.bodies.add(net);
    world::CameraSpec camera;
    camera.name = "main";
    spec.cameras.push_back(camera);
    return spec;
}

// Keeps the numbers of the frames that it was given.
class RecordingSink : public image::FrameSink {
  public:
    void write(std::int64_t frame, const image::Image&) override { frames.push_back(frame); }
    void finish() override { finished = true; }
    std::filesystem::path companion(const std::string& name) const override { return name; }

    std::vector<std::int64_t> frames;
    bool finished = false;
};

image::Image smallPicture(const view::FrameView&) {
    return {1, 1, {1, 2, 3}};
}

const std::atomic<bool> never = false;

RunResult playWithoutPictures(const world::SceneSpec& spec, const RunOptions& options) {
    world::World world(spec);
    return play(world, options, {}, nullptr, {}, never);
}

TEST(Play, FrameCountIsSecondsTimesRateAndAtLeastOne) {
    EXPECT_EQ(frameCount({.fps = 60.0, .seconds = 8.0}), 480);
    EXPECT_EQ(frameCount({.fps = 30.0, .seconds = 0.1}), 3);
    EXPECT_EQ(frameCount({.fps = 30.0, .seconds = 0.001}), 1);
}

// Where the bob is in a view: the last ball.
glm::vec3 bobOf(const view::FrameView& view) {
    return glm::vec3(view.surfaces.back().transform[3]);
}

TEST(Play, MomentsOfAnExposureLieAroundTheFrameAndChangeNoState) {
    std::vector<view::FrameView> blurred, fine;
    const auto played = [](const world::SceneSpec& spec, const RunOptions& options,
                           std::vector<view::FrameView>& views) {
        world::World world(spec);
        RecordingSink sink;
        const Draw draw = [&](const view::FrameView& view) {
            views.push_back(view);
            return smallPicture(view);
        };
        return play(world, options, draw, &sink, {}, never);
    };
    const RunResult result = played(pendulum(), {.lastFrame = 20, .blurMoments = 2}, blurred);
    const RunResult plain = playWithoutPictures(pendulum(), {.lastFrame = 20});
    for (std::size_t i = 0; i < 21; ++i) EXPECT_EQ(result.frames[i].hash, plain.frames[i].hash);
    // Half of a thirtieth of a second is open; the middles of its two halves are 1/240 s before and after the frame,
    // where a run with 240 frames a second has one each. In between the bob, at up to 5 m/s, goes on evenly: off by
    // a t²/2, with the spring's 100 m/s² for each metre that it is too long and the 9.8 m/s² of gravity.
    world::SceneSpec spec = pendulum();
    spec.run.fps = 240.0;
    played(spec, {.lastFrame = 161}, fine);
    for (std::size_t i = 1; i < 21; ++i) {
        const view::FrameView& view = blurred[i];
        ASSERT_EQ(view.moments.size(), 2U);
        EXPECT_NEAR(view.moments[0].time, view.time - 1.0 / 240.0, 1e-12);
        for (const int side : {0, 1}) {
            const glm::vec3 exact = bobOf(fine[8 * i + (side == 0 ? 0U : 2U) - 1]);
            EXPECT_NEAR(glm::distance(bobOf(view.moments[side]), exact), 0.0, 1e-3) << i;
        }
    }
    EXPECT_GT(glm::distance(bobOf(blurred[5].moments[0]), bobOf(blurred[5].moments[1])), 0.005F);
}

TEST(Play, FrameShowsTheMomentOfItsNumber) {
    const RunResult result = playWithoutPictures(pendulum(), {.lastFrame = 12});
    ASSERT_EQ(result.frames.size(), 13U);
    std::set<std::uint64_t> hashes;
    for (std::size_t i = 0; i < result.frames.size(); ++i) {
        EXPECT_EQ(result.frames[i].frame, static_cast<std::int64_t>(i));
        // One division of whole numbers: exact up to the rounding of the quotient.
        EXPECT_DOUBLE_EQ(result.frames[i].time, static_cast<double>(i) / 30.0);
        EXPECT_FALSE(result.frames[i].pictured);
        hashes.insert(result.frames[i].hash);
    }
    EXPECT_EQ(hashes.size(), 13U) << "a swinging pendulum is never twice in the same chained state";
}

TEST(Play, DrawsOnlyTheWantedFramesAndSimulatesTheSame) {
    world::World world(pendulum());
    RecordingSink sink;
    const RunResult drawn = play(world, {.firstFrame = 4, .lastFrame = 9}, smallPicture, &sink, {}, never);
    EXPECT_EQ(sink.frames, (std::vector<std::int64_t>{4, 5, 6, 7, 8, 9}));
    EXPECT_TRUE(sink.finished);
    const RunResult bare = playWithoutPictures(pendulum(), {.lastFrame = 9});
    ASSERT_EQ(drawn.frames.size(), bare.frames.size());
    for (std::size_t i = 0; i < bare.frames.size(); ++i) {
        EXPECT_EQ(drawn.frames[i].hash, bare.frames[i].hash);
        EXPECT_EQ(drawn.frames[i].pictured, i >= 4);
    }
}

TEST(Play, ListenerHearsEachFrameAndTickInOrder) {
    world::World world(pendulum());
    RecordingSink sink;
    std::vector<std::int64_t> frames, ticks;
    const RunListener listener{.frameDone = [&](const FrameRecord& record) { frames.push_back(record.frame); },
                               .tickDone = [&](std::int64_t tick, std::uint64_t) { ticks.push_back(tick); }};
    play(world, {.lastFrame = 5}, smallPicture, &sink, listener, never);
    EXPECT_EQ(frames, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
    ASSERT_EQ(static_cast<int>(ticks.size()), 5 * world.ticksPerFrame() + 1);
    for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i], static_cast<std::int64_t>(i));
}

TEST(Play, StoppingKeepsWholeFramesAndFinishesTheOutput) {
    world::World world(pendulum());
    RecordingSink sink;
    std::atomic<bool> stop = false;
    const RunListener listener{.frameDone = [&](const FrameRecord& record) {
        if (record.frame == 2) stop = true;
    }};
    const RunResult result = play(world, {.lastFrame = 100000}, smallPicture, &sink, listener, stop);
    EXPECT_TRUE(result.interrupted);
    EXPECT_TRUE(sink.finished);
    EXPECT_GE(result.frames.size(), 3U);
    ASSERT_EQ(sink.frames.size(), result.frames.size());
    EXPECT_EQ(sink.frames.back(), result.frames.back().frame);
}

// A step of 1/60 s by hand: ω h = 1000 / 60, far beyond the limit 2 of leap-frog.
TEST(Play, DivergenceKeepsTheFramesSoFar) {
    world::SceneSpec spec = pendulum();
    spec.bodies.of<world::NetSpec>()[0].springs[0].stiffness = 1e6;
    spec.bodies.of<world::NetSpec>()[0].springs[0].restLength = 1.0;
    spec.solver.dt = 1.0 / 60.0;
    world::World world(spec);
    RecordingSink sink;
    const RunResult result = play(world, {.lastFrame = 600}, smallPicture, &sink, {}, never);
    ASSERT_TRUE(result.divergence.has_value());
    EXPECT_EQ(result.divergence->body, "net.pendulum");
    EXPECT_FALSE(result.divergence->message.empty());
    EXPECT_TRUE(sink.finished);
    EXPECT_GE(sink.frames.size(), 1U);
    EXPECT_LT(sink.frames.size(), 600U);
    EXPECT_EQ(sink.frames.size(), result.frames.size());
}

TEST(Play, FailureOfTheFilesIsRethrown) {
    class FullDisk : public RecordingSink {
      public:
        void write(std::int64_t, const image::Image&) override {
            throw core::Error(core::ErrorKind::inputOutput, "disk full");
        }
    } sink;
    world::World world(pendulum());
    EXPECT_THROW(play(world, {.lastFrame = 50}, smallPicture, &sink, {}, never), core::Error);
    EXPECT_FALSE(sink.finished);
}

TEST(RunRecord, MetricsHaveALineAFrameWithTheColumnsOfTheHeading) {
    const RunResult result = playWithoutPictures(pendulum(), {.lastFrame = 6, .metrics = true});
    std::stringstream lines;
    writeMetricsCsv([&](std::string_view text) { lines << text; }, pendulum(), result);
    std::string heading, line;
    std::getline(lines, heading);
    EXPECT_TRUE(heading.starts_with("frame,time_s,kinetic_J,elastic_J,gravitational_J,total_J,"));
    EXPECT_TRUE(
        heading.ends_with(",torn_springs,volume_ratio,penetration_m,body_contacts,crossings,face_penetration_m,"
                          "squeezed,max_speed_m_per_s,"
                          "asleep,slept_J"));
    int count = 0;
    while (std::getline(lines, line)) {
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(heading.begin(), heading.end(), ','));
        EXPECT_TRUE(line.starts_with(std::to_string(count) + ","));
        EXPECT_NE(line.find(",,,,"), std::string::npos) << "contact of bodies, of which none touches: " << line;
        ++count;
    }
    EXPECT_EQ(count, 7);
    EXPECT_GT(result.frames[3].metrics->kinetic, 0.0);
}

TEST(RunRecord, FiguresAreColumnsOfSeventeenDigits) {
    const auto figures = [](const world::World& world) { return std::vector<double>{world.time() / 3.0, NAN}; };
    RunOptions options{.lastFrame = 1, .metrics = true, .figures = figures};
    options.figureColumns = {2, 0};
    const RunResult result = playWithoutPictures(pendulum(), options);
    std::string csv;
    writeMetricsCsv([&](std::string_view text) { csv += text; }, pendulum(), result,
                    {"time / 3", "distance(a.b, c.d)"});
    EXPECT_NE(csv.find(",time / 3,\"distance(a.b, c.d)\"\n"), std::string::npos) << csv;
    const std::string last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
    EXPECT_EQ(result.frames[1].time, 1.0 / 30.0);
    EXPECT_TRUE(last.ends_with(",0.011111111111111112,\n")) << last;
}

TEST(RunRecord, JsonTellsWhatWasComputedAndOnWhat) {
    world::SceneSpec spec = pendulum();
    world::WindSpec& wind = spec.forces.add(world::WindSpec{});
    wind.name = "breeze";
    wind.gustAmplitude = 1.0;
    wind.gustSeed = 7;
    const world::World world(spec);
    const RunResult result = playWithoutPictures(spec, {.lastFrame = 3});
    const RunRequest request{.output = "out", .overrides = {"run.fps=30"}, .threads = 2, .options = {.lastFrame = 3}};
    const render::RendererInfo gl{"osmesa", "a vendor", "a renderer", "3.3"};
    std::string text;
    writeRunJson([&](std::string_view part) { text += part; }, spec, world, request, machine(), gl, result);
    const auto json = nlohmann::json::parse(text);
    EXPECT_EQ(json["ended"], "complete");
    EXPECT_EQ(json["scene"], "pendulum.toml");
    EXPECT_EQ(json["threads"], 2);
    EXPECT_EQ(json["gl"]["renderer"], "a renderer");
    EXPECT_EQ(json["seeds"]["wind.breeze.gust.seed"], 7);
    EXPECT_EQ(json["islands"].size(), 1U);
    EXPECT_EQ(json["islands"][0]["bodies"][0], "net.pendulum");
    EXPECT_GT(json["islands"][0]["step_s"].get<double>(), 0.0);
    EXPECT_FALSE(json["machine"]["compiler"].get<std::string>().empty());
    ASSERT_EQ(json["state_hash"].size(), 4U);
    EXPECT_EQ(std::stoull(json["state_hash"][2].get<std::string>(), nullptr, 16), result.frames[2].hash);
}

}  // namespace
}  // namespace taut::pipeline
