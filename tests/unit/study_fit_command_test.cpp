// `taut fit` as a person calls it: table, JSON, written file, measured curves, exit codes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "image_support.h"
#include "program_support.h"
#include "taut/core/whole_file.h"

namespace taut::game {
namespace {

using test::has;
using test::Outcome;
using test::run;
using test::TemporaryFolder;

// A rope that is thrown up, slowed by drag, without a force inside.
const std::string thrownRope = R"(# A rope.
schema = 1

[run]
seconds = 1.0

[rope.r]
ends = [[0, 0, 0], [1, 0, 0]]
segments = 2
velocity = [0, 8, 0]
drag_per_s = 0.3     # a guess

[fit]
keys = ["rope.r.drag_per_s"]
low = [0.01]
high = [10]
)";

std::filesystem::path sceneWith(const TemporaryFolder& folder, const std::string& targets) {
    const auto path = folder / "rope.toml";
    test::writeText(path, thrownRope + targets);
    return path;
}

// y = ((v + g/c)(1 - exp(-c t)) - g t) / c of a point thrown up with 8 m/s and drag c.
double heightAt(double c, double t) {
    return ((8 + 9.81 / c) * (1 - std::exp(-c * t)) - 9.81 * t) / c;
}

TEST(FitCommand, WritesTheFoundValueAndKeepsTheRest) {
    const TemporaryFolder folder;
    std::string curve = "time,height\n# by hand\n";
    // Between ticks too.
    for (double t = 0.05; t < 0.9; t += 0.07)
        curve += std::to_string(t) + ", " + std::to_string(heightAt(0.8, t)) + "\r\n";
    test::writeText(folder / "heights.csv", curve);
    const std::string targets =
        "\n[[fit.target]]\nthat = \"position(rope.r).y\"\ncurve = \"heights.csv\"\nsigma = 2e-3\n";
    const auto path = sceneWith(folder, targets);
    EXPECT_EQ(run({"check", path.string()}).code, 0);
    const Outcome dry = run({"fit", path.string(), "--quiet"});
    EXPECT_EQ(dry.code, 0) << dry.err;
    EXPECT_EQ(core::fileContent(path), thrownRope + targets);

    const auto json = folder / "fit.json";
    const Outcome outcome = run({"fit", path.string(), "--quiet", "--write", "-o", json.string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.substr(0, dry.out.size()), dry.out) << "every run gives the same";
    for (const char* part : {"Seeks 1 number by 13 measured values.", "Trials", "13 values of heights.csv",
                             "The targets are met.", "1 value written"})
        EXPECT_TRUE(has(outcome.out, part)) << part << "\n" << outcome.out;
    const auto fit = nlohmann::json::parse(core::fileContent(json));
    const double found = fit["keys"][0]["value"].get<double>();
    EXPECT_NEAR(found, 0.8, 0.008) << "steps of a tick, and heights to 1e-6";
    std::string expected = thrownRope + targets;
    expected.replace(expected.find("0.3"), 3, fit["changes"][0]["value"].get<std::string>());
    EXPECT_EQ(core::fileContent(path), expected);
}

TEST(FitCommand, EndsWithFiveAndWritesNothingWhenATargetCannotBeMet) {
    const TemporaryFolder folder;
    const std::string targets =
        "\n[[fit.target]]\nthat = \"position(rope.r).y\"\nat = 0.5\nvalue = 5.0\nsigma = 0.01\n";
    const auto path = sceneWith(folder, targets);
    const Outcome outcome = run({"fit", path.string(), "--quiet", "--write"});
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "starts: with the best numbers found, position(rope.r).y is ")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "rope.r.drag_per_s is at its bound: the targets would have it lower than 0.01."));
    EXPECT_TRUE(has(outcome.out, "nothing is written"));
    EXPECT_EQ(core::fileContent(path), thrownRope + targets);
    EXPECT_EQ(run({"fit", path.string(), "--quiet", "--write", "--set", "run.seconds=2"}).code, 2)
        << "--write and --set contradict each other";
}

TEST(FitCommand, AsksForWhatToFit) {
    const TemporaryFolder folder;
    const auto path = folder / "empty.toml";
    test::writeText(path, "schema = 1\n[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\n");
    const Outcome outcome = run({"fit", path.string(), "--quiet"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_TRUE(has(outcome.err, "the scene has nothing to fit: add [fit]")) << outcome.err;
}

}  // namespace
}  // namespace taut::game
