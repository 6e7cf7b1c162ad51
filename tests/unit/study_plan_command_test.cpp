// `taut plan` as a person calls it: table, JSON, written file, exit codes.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "game/scene_file.h"
#include "image_support.h"
#include "program_support.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::game {
namespace {

using test::has;
using test::Outcome;
using test::run;
using test::TemporaryFolder;

const std::string rope = R"(# A rope.
schema = 1

[need]
rms_position_m = 8e-3   # eight millimetres
horizon_s = 0.1

[run]
seconds = 1.0

[rope.r]   # swings
ends = [[0.0, 2.0, 0.0], [1.0, 2.0, 0.0]]
segments = 24     # too many
stretch_N = 60.0
mass_kg = 0.5
damping_time_s = 1e-3
hold = ["start"]
)";

std::filesystem::path fileOf(const TemporaryFolder& folder, const std::string& text) {
    const auto path = folder / "rope.toml";
    test::writeText(path, text);
    return path;
}

TEST(PlanCommand, PrintsTheEvidenceAndKeepsTheFile) {
    const TemporaryFolder folder;
    const auto path = fileOf(folder, rope);
    const Outcome outcome = run({"plan", path.string(), "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    for (const char* part : {"Force generators", "Resolution", "Candidates", "implicit-euler", "as written", "chosen",
                             "cost a frame", "Verification", "rope.r.segments = ", "The need is met"})
        EXPECT_TRUE(has(outcome.out, part)) << part << "\n" << outcome.out;
    EXPECT_EQ(core::fileContent(path), rope);
}

TEST(PlanCommand, WritesTheChangedValuesOnly) {
    const TemporaryFolder folder;
    const auto path = fileOf(folder, rope);
    const auto json = folder / "plan.json";
    const Outcome outcome = run({"plan", path.string(), "--quiet", "--write", "-o", json.string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto plan = nlohmann::json::parse(core::fileContent(json));
    EXPECT_TRUE(plan["met"].get<bool>());
    EXPECT_GT(plan["candidates"].size(), 7U) << "every method";
    EXPECT_GT(plan["cost_as_written_over_planned"].get<double>(), 1.0);
    std::string segments;
    for (const auto& change : plan["changes"])
        if (change["key"] == "rope.r.segments") segments = change["value"];
    ASSERT_FALSE(segments.empty());

    const std::string written = core::fileContent(path);
    EXPECT_TRUE(has(written, "segments = " + segments + "     # too many\n")) << written;
    EXPECT_TRUE(written.starts_with(rope.substr(0, rope.find("segments")))) << written;

    // A scene that was planned once needs no change.
    const Outcome again = run({"plan", path.string(), "--quiet", "--write"});
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(run({"check", path.string()}).code, 0);
}

TEST(PlanCommand, EndsWithFiveWhenTheNeedCannotBeMet) {
    const TemporaryFolder folder;
    const auto path = fileOf(folder, rope);
    const Outcome budget = run({"plan", path.string(), "--quiet", "--write", "--set", "need.budget_ms=1e-8"});
    EXPECT_EQ(budget.code, 2) << "--write and --set contradict each other";
    const Outcome outcome = run({"plan", path.string(), "--quiet", "--set", "need.budget_ms=1e-8"});
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "times the 1e-08 ms allowed")) << outcome.out;
    const Outcome fine =
        run({"plan", path.string(), "--quiet", "--effort", "0.01", "--set", "need.rms_position_m=1e-8"});
    EXPECT_EQ(fine.code, 5) << fine.err;
    EXPECT_TRUE(has(fine.out, "not met within the effort: the nearest, leapfrog")) << fine.out;
    EXPECT_EQ(core::fileContent(path), rope);
}

TEST(PlanCommand, SaysWhatItDidNotLookAt) {
    const TemporaryFolder folder;
    const auto path = fileOf(folder, rope);
    const auto json = folder / "plan.json";
    const Outcome outcome = run({"plan", path.string(), "--quiet", "--write", "-o", json.string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "between 0.1 s and the end of the run at 1 s was not simulated")) << outcome.out;
    EXPECT_TRUE(has(outcome.err, "warning: the time from 0.1 s to 1 s was not simulated")) << outcome.err;
    // 0.9: a second of which a tenth was looked at; 1e-12 rounding.
    EXPECT_NEAR(nlohmann::json::parse(core::fileContent(json))["not_looked_at_s"].get<double>(), 0.9, 1e-12);
}

TEST(PlanCommand, ShowsNoTimeOfWhatWasStopped) {
    const TemporaryFolder folder;
    const auto path = fileOf(folder, rope);
    const auto json = folder / "plan.json";
    // Here the products of the implicit step's solver come to more than leap-frog's steps, which only a run tells.
    ASSERT_EQ(run({"plan", path.string(), "--quiet", "-o", json.string(), "--effort", "0.05", "--set",
                   "need.rms_position_m=4e-3", "--set", "need.horizon_s=0.3"})
                  .code,
              0);
    const auto plan = nlohmann::json::parse(core::fileContent(json));
    int stopped = 0;
    for (const auto& trial : plan["candidates"]) {
        if (!trial["was_stopped"].get<bool>()) continue;
        ++stopped;
        EXPECT_TRUE(trial["ms_per_frame"].is_null());
        EXPECT_TRUE(trial["cost_is_lower_bound"].get<bool>());
    }
    EXPECT_GT(stopped, 0) << "else this shows nothing";
}

TEST(PlanCommand, PlansBeyondThePredictableTimeAreNotWritten) {
    const TemporaryFolder folder;
    const std::string buckling = R"(schema = 1
[need]
rms_position_m = 1e-3
horizon_s = 0.5
[run]
seconds = 1.0
[world]
gravity = [0, 0, 0]
[rope.r]
ends = [[0.0, 2.0, 0.0], [0.1, 2.0, 0.0]]
segments = 8
stretch_N = 500.0
mass_kg = 0.05
velocity = [-5.0, 0.0, 0.0]
hold = ["start"]
)";
    const auto path = fileOf(folder, buckling);
    const Outcome outcome = run({"plan", path.string(), "--quiet", "--write", "--effort", "0.01"});
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "The motion is chaotic")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "nothing is written")) << outcome.out;
    EXPECT_EQ(core::fileContent(path), buckling);
}

TEST(PlanCommand, WhereNothingCanMoveThereIsNothingToPlan) {
    const TemporaryFolder folder;
    const auto path = fileOf(folder, rope.substr(0, rope.find("hold")) + "hold = [\"all\"]\n");
    const Outcome outcome = run({"plan", path.string(), "--quiet"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_TRUE(has(outcome.err, "nothing in the scene can move")) << outcome.err;
}

TEST(PlanCommand, AFileThatChangedMeanwhileIsLeftAlone) {
    const TemporaryFolder folder;
    const auto path = fileOf(folder, rope + "# somebody was here\n");
    EXPECT_THROW(replaceSceneFile(path, rope, "new"), core::Error);
    EXPECT_EQ(core::fileContent(path), rope + "# somebody was here\n");
    replaceSceneFile(path, rope + "# somebody was here\n", "new");
    EXPECT_EQ(core::fileContent(path), "new");
}

TEST(PlanCommand, AsksForANeed) {
    const TemporaryFolder folder;
    const auto path = fileOf(folder, "schema = 1\n[rope.r]\nends = [[0, 2, 0], [1, 2, 0]]\n");
    const Outcome outcome = run({"plan", path.string(), "--quiet"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_TRUE(has(outcome.err, "the scene has no need: add [need]")) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "horizon_s = 0.5")) << outcome.err;
}

}  // namespace
}  // namespace taut::game
