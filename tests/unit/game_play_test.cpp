#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <thread>

#include "game/file_watch.h"
#include "game/play_figures.h"
#include "game/play_quality.h"
#include "image_support.h"
#include "program_support.h"
#include "taut/image/read.h"
#include "taut/spec/picture_spec.h"

namespace taut::game {
namespace {

using test::has;
using test::Outcome;
using test::run;
using test::TemporaryFolder;

std::string springFile(const TemporaryFolder& folder) {
    const auto path = folder / "spring.toml";
    test::writeText(path, R"(schema = 1
[run]
fps = 20
seconds = 0.2
[picture]
size = [640, 360]
samples = 1
shadow_size = 256
[net.spring]
points = [ { name = "nail", position = [0, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0] } ]
springs = [ { a = "nail", b = "bob", stiffness_N_per_m = 100.0 } ]
)");
    return path.string();
}

TEST(PlayCommand, WithoutADisplaySaysHowToDoWithout) {
    const TemporaryFolder folder;
    for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"}) ::unsetenv(variable);
    const Outcome outcome = run({"play", springFile(folder)});
    EXPECT_EQ(outcome.code, 7);
    EXPECT_TRUE(has(outcome.err, "taut render " + springFile(folder))) << outcome.err;
}

TEST(PlayCommand, AWrongSceneIsSaidBeforeAWindowIsMissed) {
    EXPECT_EQ(run({"play", "no-such-scene"}).code, 6);
    EXPECT_EQ(run({"play", "curtain", "--record", "pulled.mp4"}).code, 2);
    EXPECT_EQ(run({"play", "curtain", "--quality", "best"}).code, 2);
}

TEST(PlayFigures, AreNeverOverTheHand) {
    const pipeline::PictureBox left{{8.0F, 8.0F}, {200.0F, 160.0F}}, right{{312.0F, 8.0F}, {504.0F, 160.0F}};
    FiguresPlace figures;
    figures.follow(left, 512.0F, glm::vec2(300.0F, 100.0F), {}, 0.1);
    EXPECT_FALSE(figures.isAtRight());
    figures.follow(left, 512.0F, glm::vec2(100.0F, 100.0F), {}, 0.1);
    EXPECT_TRUE(figures.isAtRight());
    EXPECT_EQ(figures.opacity(), 1.0F);
    figures.follow(right, 512.0F, glm::vec2(400.0F, 100.0F), {}, 0.1);
    EXPECT_FALSE(figures.isAtRight());
    // In a picture that they fill from side to side they go.
    const pipeline::PictureBox wide{{8.0F, 8.0F}, {248.0F, 160.0F}};
    for (int i = 0; i < 20; ++i) figures.follow(wide, 256.0F, glm::vec2(128.0F, 100.0F), {}, 0.1);
    EXPECT_EQ(figures.opacity(), 0.0F);
}

TEST(PlayFigures, LetTheBodyThatIsPulledShineThrough) {
    const pipeline::PictureBox left{{8.0F, 8.0F}, {200.0F, 160.0F}};
    const std::vector<glm::vec2> body{{150.0F, 50.0F}};
    FiguresPlace figures;
    const auto follow = [&](std::optional<glm::vec2> hand) {
        for (int i = 0; i < 20; ++i) figures.follow(left, 512.0F, hand, body, 0.1);
        return figures.opacity();
    };
    EXPECT_EQ(follow(std::nullopt), 1.0F);
    EXPECT_LT(follow(glm::vec2(300.0F, 100.0F)), 0.3F);
    EXPECT_EQ(follow(std::nullopt), 1.0F);
}

TEST(PlayQuality, LevelsEndWithTheScenesOwnAndNoneIsFiner) {
    world::PictureSpec scene;
    scene.samples = 1;
    scene.shadowSize = 512;
    const std::vector<DrawingLevel> levels = drawingLevels(scene);
    EXPECT_EQ(levels.back().name, "full");
    for (std::size_t i = 0; i < levels.size(); ++i) {
        EXPECT_EQ(levels[i].samples, 1);
        EXPECT_LE(levels[i].shadowSize, 512);
        if (i > 0) EXPECT_FALSE(levels[i].looksAs(levels[i - 1])) << levels[i].name;
    }
    EXPECT_EQ(levelNamed("normal", scene).shadowSize, 1024);
}

// The figures cover a corner; everything else, and every picture without the flag, is as it was.
// Frames at 20 a second, three ticks apart.
TEST(RenderCommand, AStillIsThePictureOfItsMomentAndLeavesNoRecord) {
    const TemporaryFolder folder, alone;
    const std::string file = springFile(folder);
    ASSERT_EQ(run({"render", file, "-o", (folder / "frame_######.png").string(), "--quiet", "--size", "64x36"}).code,
              0);
    const auto still = [&](const std::string& at, const std::string& name) {
        return run({"render", file, "-o", (alone / name).string(), "--quiet", "--size", "64x36", "--at", at}).code;
    };
    ASSERT_EQ(still("0.104", "still.png"), 0);
    ASSERT_EQ(still("0.05,0.12,0.15", "still_##.png"), 0);
    const auto pixels = [](const std::filesystem::path& path) { return image::readImage(path).rgb; };
    EXPECT_EQ(pixels(alone / "still.png"), pixels(folder / "frame_000002.png"));
    EXPECT_EQ(pixels(alone / "still_00.png"), pixels(folder / "frame_000001.png"));
    EXPECT_EQ(pixels(alone / "still_02.png"), pixels(folder / "frame_000003.png"));
    EXPECT_NE(pixels(alone / "still_01.png"), pixels(folder / "frame_000002.png"));  // a tick between two frames
    EXPECT_EQ(alone.entryCount(), 4);
}

TEST(RenderCommand, AStillIsNoRun) {
    const TemporaryFolder folder;
    const std::string file = springFile(folder), one = (folder / "still.png").string();
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--at", "0.3"},
                                                 {"--at", "0.1,0.2"},
                                                 {"--at", "0.1", "--frames", "0-2"},
                                                 {"--at", "0.1", "--metrics"},
                                                 {"--at", "-1"}}) {
        std::vector<std::string> arguments = {"render", file, "-o", one};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run(arguments).code, 2) << more.back();
    }
    EXPECT_EQ(run({"render", file, "-o", (folder / "still.mp4").string(), "--at", "0.1"}).code, 2);
    EXPECT_FALSE(std::filesystem::exists(one));
}

TEST(FileWatch, TellsOnceOfAFileThatIsReplaced) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.toml", "schema = 1\n");
    FileWatch watch;
    watch.watch({(folder / "a.toml").string()});
    EXPECT_FALSE(watch.hasChanged());
    test::writeText(folder / "a.toml~", "schema = 1\n\n");
    std::filesystem::rename(folder / "a.toml~", folder / "a.toml");
    const auto changesWithinTwoLooks = [&] {
        bool has = false;
        for (int i = 0; i < 3; ++i) {
            std::this_thread::sleep_for(FileWatch::pause);
            has = watch.hasChanged() || has;
        }
        return has;
    };
    EXPECT_TRUE(changesWithinTwoLooks());
    EXPECT_FALSE(changesWithinTwoLooks());
}

TEST(RenderCommand, TheOverlayChangesItsCornerOnly) {
    const TemporaryFolder folder;
    const std::string file = springFile(folder);
    ASSERT_EQ(run({"render", file, "-o", (folder / "plain_######.png").string(), "--quiet"}).code, 0);
    ASSERT_EQ(run({"render", file, "-o", (folder / "over_######.png").string(), "--quiet", "--overlay"}).code, 0);
    const image::Image plain = image::readImage(folder / "plain_000003.png");
    const image::Image over = image::readImage(folder / "over_000003.png");
    ASSERT_EQ(plain.rgb.size(), over.rgb.size());
    std::size_t inside = 0, outside = 0;
    for (std::size_t i = 0; i < plain.rgb.size(); ++i) {
        if (plain.rgb[i] == over.rgb[i]) continue;
        const std::size_t x = i / 3 % 640, y = i / 3 / 640;
        ++(x < 320 && y < 180 ? inside : outside);
    }
    EXPECT_GT(inside, 50000U);  // 215 · 155 pixels, three channels, nearly all darker
    EXPECT_EQ(outside, 0U);
}

}  // namespace
}  // namespace taut::game
