#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "game/program.h"
#include "image_support.h"
#include "program_support.h"
#include "taut/image/read.h"

namespace taut::game {
namespace {

using test::has;
using test::Outcome;
using test::TemporaryFolder;

Outcome atlas(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "atlas");
    return test::run(arguments);
}

TEST(AtlasCommand, WrongWordsAreUsageErrors) {
    const Outcome method = atlas({"--methods", "rk4,leapfrg"});
    EXPECT_EQ(method.code, 2);
    EXPECT_TRUE(has(method.err, "there is no method 'leapfrg'; did you mean leapfrog?")) << method.err;
    EXPECT_EQ(atlas({"--cells", "1"}).code, 2);
    for (const char* seconds : {"0", "-1", "nan", "inf"}) {
        const Outcome wrong = atlas({"rope", "--seconds", seconds});
        EXPECT_EQ(wrong.code, 2) << seconds;
        EXPECT_TRUE(has(wrong.err, "expected a number from 0.001 to 86400")) << wrong.err;
    }
    const Outcome noScene = atlas({"--seconds", "1"});
    EXPECT_EQ(noScene.code, 2);
    EXPECT_TRUE(has(noScene.err, "name one")) << noScene.err;
    EXPECT_EQ(atlas({"rope", "--set", "run.fps=30"}).code, 2);
    EXPECT_EQ(atlas({"no/such.toml"}).code, 6);
    EXPECT_EQ(atlas({"no-such-scene"}).code, 6);
}

TEST(AtlasCommand, WritesTheMapAndThePhasePlane) {
    const TemporaryFolder folder;
    const Outcome outcome =
        atlas({"--methods", "euler,leapfrog", "--cells", "9", "--quiet", "-o", (folder / "atlas").string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(outcome.err.empty()) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "largest gap")) << outcome.out;
    for (const char* name :
         {"stability-map.csv", "stability-growth.csv", "stability-map.svg", "phase-plane.csv", "phase-plane.svg"})
        EXPECT_GT(std::filesystem::file_size(folder / "atlas" / name), 0U) << name;
    EXPECT_GT(image::readImage(folder / "atlas/stability-map.png").width, 500);
    EXPECT_GT(image::readImage(folder / "atlas/phase-plane.png").width, 500);
}

TEST(AtlasCommand, FindsThresholdsOfAScene) {
    const TemporaryFolder folder;
    test::writeText(folder / "swing.toml", R"(schema = 1
[rope.line]
ends = [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0]]
segments = 6
stretch_N = 500.0
damping_time_s = 0.0
drag_per_s = 0.0
hold = ["ends"]
)");
    const Outcome outcome = atlas({(folder / "swing.toml").string(), "--methods", "leapfrog,implicit-euler",
                                   "--seconds", "0.3", "--quiet", "-o", (folder / "out").string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "rope.line")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "a step stands when")) << outcome.out;
    const auto json = nlohmann::json::parse(test::contentOf(folder / "out/swing-thresholds.json"));
    EXPECT_EQ(json["methods"][0]["result"], "found");
    EXPECT_EQ(json["methods"][1]["result"], "above");
    EXPECT_TRUE(json["methods"][1]["by_B1_s"].is_null());
    EXPECT_TRUE(json["islands"][0]["omega_closed_form_per_s"].is_number());
    EXPECT_GT(image::readImage(folder / "out/swing-thresholds.png").width, 400);
    EXPECT_TRUE(has(test::contentOf(folder / "out/swing-thresholds.csv"), "swing,leapfrog,found,"));
}

TEST(AtlasCommand, WithoutGnuplotWritesTheTablesAndSaysSo) {
    const TemporaryFolder folder;
    const char* path = std::getenv("PATH");
    const std::string before = path == nullptr ? "" : path;
    ::setenv("PATH", (folder / "empty").c_str(), 1);
    const Outcome outcome = atlas({"rope", "--methods", "leapfrog", "--quiet", "-o", (folder / "out").string()});
    ::setenv("PATH", before.c_str(), 1);
    EXPECT_EQ(outcome.code, 6);
    EXPECT_TRUE(has(outcome.err, "gnuplot")) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "out/rope-thresholds.csv"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/rope-thresholds.json"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/rope-thresholds.png"));
}

}  // namespace
}  // namespace taut::game
