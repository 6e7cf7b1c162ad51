// Sixty scenes of the grammar, and all that are shipped: threads, instructions, questions and restored states change
// nothing.
#include "fuzz/play.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "fuzz/scene_grammar.h"
#include "fuzz/support.h"
#include "support/playing.h"

namespace taut::fuzz {
namespace {

GrownScene grownFrom(unsigned seed) {
    std::mt19937 random(seed);
    Bytes bytes(400);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 24U);
    return grownScene(bytes);
}

class GrownScenes : public testing::TestWithParam<unsigned> {};

TEST_P(GrownScenes, AreTheSameHoweverTheyArePlayed) {
    const GrownScene scene = grownFrom(GetParam());
    const PlayedScene played = playedScene(scene::loadSceneText(scene.text, "play.toml", alone()).spec, 6);
    EXPECT_EQ(played.fault, "") << scene.text;
    RecordProperty("played", played.wasPlayed ? 1 : 0);
    if (scene.isClosed) RecordProperty("energy_gain", std::to_string(played.gain));
}

INSTANTIATE_TEST_SUITE_P(Seeds, GrownScenes, testing::Range(0U, 60U));

// Every construct of the grammar is in some of a thousand scenes.
TEST(SceneGrammar, EveryKindGrows) {
    for (const std::string kind : {"[cloth.",
                                   "[rope.",
                                   "[block.",
                                   "[solid.",
                                   "[net.",
                                   "[[joint]]",
                                   "[[seam]]",
                                   "[wind.",
                                   "[anchor.",
                                   "[filling.",
                                   "shape = \"figure\"",
                                   "collider.f.upper",
                                   "kind = \"hinge\"",
                                   "kind = \"ball\"",
                                   "kind = \"slider\"",
                                   "motor_rad_per_s",
                                   "cone_deg",
                                   "do = \"cut\"",
                                   "do = \"spawn\"",
                                   "break_strain"}) {
        unsigned count = 0;
        for (unsigned seed = 0; seed < 1000; ++seed) count += grownFrom(seed).text.find(kind) != std::string::npos;
        EXPECT_GT(count, 0U) << kind;
    }
}

class ShippedScenarios : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedScenarios, DoTheSameWhateverTheyAreAskedBetweenTicks) {
    constexpr std::int64_t ticks = 3;
    scene::LoadOptions options;
    options.assetFolders = {TAUT_SOURCE_DIR "/assets"};
    const world::SceneSpec spec = scene::loadScene(GetParam(), options).spec;
    const support::Played silent = support::play(spec, {.ticks = ticks, .threads = {2}});
    const support::Played asked = support::play(spec, {.ticks = ticks, .threads = {2}, .asksEvery = 1});
    EXPECT_EQ(differenceOf(silent, asked), "");
    EXPECT_EQ(asked.fault, "");
}

std::vector<std::filesystem::path> shipped() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(TAUT_SOURCE_DIR "/assets/scenarios"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScenarios, testing::ValuesIn(shipped()), [](const auto& each) {
    std::string name = each.param.stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

}  // namespace
}  // namespace taut::fuzz
