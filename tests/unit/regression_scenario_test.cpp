#include "taut/regression/scenario.h"

#include <gtest/gtest.h>

#include "regression_support.h"

namespace taut::regression {
namespace {

using test::has;
using test::TemporaryFolder;

TEST(ScenarioFiles, OfAFolderAreItsTomlFilesByName) {
    const TemporaryFolder folder;
    for (const char* name : {"b.toml", "a.toml", "notes.txt"}) test::writeText(folder / name, "");
    std::filesystem::create_directory(folder / "golden.toml");
    const auto files = scenarioFiles({folder.path()});
    EXPECT_EQ(files, (std::vector<std::filesystem::path>{folder / "a.toml", folder / "b.toml"}));
    // A file that is named once more is not played once more.
    EXPECT_EQ(scenarioFiles({folder.path(), folder / "b.toml"}).size(), 2U);
}

TEST(ScenarioFiles, MissingOrAmbiguousEntriesAreRefused) {
    const TemporaryFolder folder;
    const auto missing = [&](const std::string& name) {
        return test::messageOf(core::ErrorKind::inputOutput, [&] { scenarioFiles({folder / name}); });
    };
    EXPECT_TRUE(has(missing("none"), "none: there is no such file or folder of scenarios"));
    std::filesystem::create_directory(folder / "empty");
    EXPECT_TRUE(has(missing("empty"), "empty: there is no scenario in this folder"));
    std::filesystem::create_directory(folder / "other");
    for (const char* name : {"same.toml", "other/same.toml"}) test::writeText(folder / name, "");
    const std::string twice = test::messageOf(core::ErrorKind::usage, [&] {
        scenarioFiles({folder.path(), folder / "other"});
    });
    EXPECT_TRUE(has(twice, "two scenarios are called same")) << twice;
}

TEST(Scenarios, FaultsAreSaidOfEachAndKeepNoneOfTheOthersOut) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.toml", "schema = 1\n[run]\nfps = -3\n");
    test::writeText(folder / "b.toml", "schema = 1\n[run]\nsecond = 3\n");
    test::writeText(folder / "c.toml", test::springText());
    const ReadScenarios read = readScenarios({folder / "a.toml", folder / "b.toml", folder / "c.toml"}, {});
    ASSERT_EQ(read.unread.size(), 2U);
    EXPECT_TRUE(has(read.unread[0].fault, "a.toml:3:")) << read.unread[0].fault;
    EXPECT_TRUE(has(read.unread[1].fault, "b.toml:3:")) << read.unread[1].fault;
    ASSERT_EQ(read.scenarios.size(), 1U);
    EXPECT_EQ(read.scenarios[0].name, "c");
}

world::GoldenSpec golden(std::vector<int> frames, bool restart, bool debug, const std::string& camera) {
    world::GoldenSpec spec;
    spec.frames = std::move(frames);
    spec.restart = restart;
    spec.debug = debug;
    spec.camera = camera;
    return spec;
}

TEST(GoldenRequests, AreByFrameWithANameForEach) {
    world::SceneSpec spec;
    spec.run = {20.0, 1.0};
    spec.cameras.emplace_back().name = "side";
    spec.goldens = {golden({7, 3}, false, false, ""), golden({3}, false, true, ""), golden({3}, true, true, "side")};
    std::vector<std::string> keys;
    for (const GoldenRequest& request : goldenRequests(spec)) keys.push_back(request.key());
    EXPECT_EQ(keys, (std::vector<std::string>{"000003", "000003-debug", "000003-side-debug", "000007"}));
}

TEST(GoldenRequests, ThatCannotBeMeantAreRefused) {
    world::SceneSpec spec;
    spec.run = {20.0, 1.0};
    const auto said = [&](std::vector<int> frames, const std::string& camera = "") {
        spec.goldens = {golden(std::move(frames), false, false, camera)};
        spec.goldens[0].source = {"s.toml", 9, 1};
        return test::messageOf(core::ErrorKind::badContent, [&] { goldenRequests(spec); });
    };
    EXPECT_TRUE(has(said({20}), "s.toml:9:1: error: there is no frame 20: the run has frames 0 to 19"));
    EXPECT_TRUE(has(said({-1}), "there is no frame -1"));
    EXPECT_TRUE(has(said({4, 4}), "frame 4 is asked for twice"));
    EXPECT_TRUE(has(said({4}, "top"), "there is no camera 'top'"));
}

}  // namespace
}  // namespace taut::regression
