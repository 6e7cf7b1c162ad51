#include "game/flags.h"

#include <gtest/gtest.h>

#include <csignal>
#include <utility>

#include "game/interruption.h"
#include "game/progress.h"
#include "game/suggestion.h"
#include "taut/core/error.h"
#include "taut/core/private/edit_distance.h"

namespace taut::game {
namespace {

TEST(Flags, FrameRangesHaveThreeForms) {
    EXPECT_EQ(frameRange("0-119").first, 0);
    EXPECT_EQ(frameRange("0-119").last, 119);
    EXPECT_EQ(frameRange("60").first, 60);
    EXPECT_EQ(frameRange("60").last, 60);
    EXPECT_EQ(frameRange("60-").first, 60);
    EXPECT_FALSE(frameRange("60-").last.has_value());
}

TEST(Flags, BadFrameRangesAreUsageErrors) {
    for (const char* text : {"", "-", "-5", "a-b", "5-3", "1-2-3", "1.5", "0x10", " 1", "99999999999999999999"}) {
        try {
            frameRange(text);
            ADD_FAILURE() << "'" << text << "'";
        } catch (const core::Error& error) {
            EXPECT_EQ(error.kind(), core::ErrorKind::usage);
        }
    }
}

TEST(Flags, SizeIsWidthAndHeight) {
    EXPECT_EQ(pictureSize("1280x720").width, 1280);
    EXPECT_EQ(pictureSize("1280x720").height, 720);
    for (const char* text :
         {"", "x", "1280", "1280x", "x720", "0x720", "-1x5", "15x16", "16x16385", "1280 x 720", "1e3x5"})
        EXPECT_THROW(pictureSize(text), core::Error) << text;
}

TEST(Flags, SmoothSaysHowFineAllIsDrawnOrNothing) {
    std::vector<std::string> overrides;
    addSmoothOverride(-1, overrides);
    EXPECT_TRUE(overrides.empty());
    addSmoothOverride(0, overrides);
    EXPECT_EQ(overrides, std::vector<std::string>{"picture.smooth=0 # --smooth"});
}

TEST(Suggestion, DistanceCountsInsertionsRemovalsReplacementsAndSwaps) {
    EXPECT_EQ(core::editDistance("flag", "flag"), 0);
    EXPECT_EQ(core::editDistance("flag", "flags"), 1);
    EXPECT_EQ(core::editDistance("flag", "fag"), 1);
    EXPECT_EQ(core::editDistance("flag", "flog"), 1);
    EXPECT_EQ(core::editDistance("flag", "falg"), 1);
    EXPECT_EQ(core::editDistance("", "abc"), 3);
}

TEST(Suggestion, NearestIsOfferedAndFarOnesAreNot) {
    EXPECT_EQ(didYouMean("rendr", {"check", "render", "info"}), "; did you mean render?");
    EXPECT_EQ(didYouMean("xyzzy", {"check", "render", "info"}), "");
    EXPECT_EQ(didYouMean("x", {}), "");
}

TEST(Progress, ClockIsWrittenForPeople) {
    EXPECT_EQ(clockText(7.4), "0:07");
    EXPECT_EQ(clockText(725.0), "12:05");
    EXPECT_EQ(clockText(3725.0), "1:02:05");
}

// 30 frames at 30 a second are a second of scene time; it took two.
TEST(Progress, LineTellsShareSpeedAndTimeLeft) {
    Progress progress({.frames = 120, .fps = 30.0, .step = {.step = 0.0005, .limit = 0.0006}}, true);
    pipeline::FrameRecord record{
        .frame = 29, .pictured = true, .simulating = 0.004, .drawing = 0.08, .encoding = 0.011};
    const std::string line = progress.line(record, 2.0, 66.0);
    for (const char* part : {"frame 30/120", "25 %", "1:06 left", "simulation 4.0 picture 80 file 11 ms",
                             "0.50 x real time", "h 0.5, limit 0.6 ms"})
        EXPECT_NE(line.find(part), std::string::npos) << part << " is missing in: " << line;
    record.metrics = world::Metrics{.kinetic = 1.0, .elastic = 2.0, .gravitational = 4.0, .maxStrain = 0.05};
    EXPECT_NE(progress.line(record, 2.0, 66.0).find("strain 5.0 %  energy 7 J, drift +0 J"), std::string::npos);
    progress.frameDone(record);  // shown or not, the first record is where energy drifts from
    record.metrics->kinetic = 0.5;
    EXPECT_NE(progress.line(record, 2.0, 66.0).find("energy 6.5 J, drift -0.5 J"), std::string::npos);
}

TEST(Progress, ARunThatGoesOnDriftsFromItsStart) {
    Progress progress({.frames = 120, .firstEnergy = 10.0}, true);
    pipeline::FrameRecord record{.frame = 60};
    record.metrics = world::Metrics{.kinetic = 7.0};
    progress.frameDone(record);
    EXPECT_NE(progress.line(record, 2.0, 66.0).find("energy 7 J, drift -3 J"), std::string::npos);
}

TEST(Interruption, FirstSignalSetsTheFlagAndTheExitCode) {
    for (const auto& [signal, code] : {std::pair{SIGINT, ExitCode::interrupted}, {SIGTERM, ExitCode::terminated}}) {
        const Interruption interruption;
        EXPECT_FALSE(interruption.flag());
        EXPECT_FALSE(interruption.exitCode().has_value());
        std::raise(signal);
        EXPECT_TRUE(interruption.flag());
        EXPECT_EQ(interruption.exitCode(), code);
    }
}

}  // namespace
}  // namespace taut::game
