// The calibration finds the mutants with the thresholds that are used, and refuses thresholds that let one through.
#include "taut/regression/calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regression_support.h"
#include "taut/bodies/cloth.h"
#include "taut/core/private/child_process.h"
#include "taut/image/png.h"
#include "taut/pipeline/run_parts.h"
#include "taut/regression/judging.h"
#include "taut/regression/mutants.h"
#include "taut/regression/playing.h"

namespace taut::regression {
namespace {

using test::TemporaryFolder;

// Shadow, damping, a net with two springs: every mutant has something to change.
Scenario scenario(const TemporaryFolder& folder) {
    test::writeText(folder / "spring.toml", R"(schema = 1
[run]
fps = 20
seconds = 0.5
[net.spring]
points = [ { name = "a", position = [-0.5, 2, 0], hold = true }, { name = "b", position = [0.5, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0] } ]
springs = [ { a = "a", b = "bob", stiffness_N_per_m = 100.0 }, { a = "b", b = "bob", stiffness_N_per_m = 100.0 } ]
ball = 0.3
[collider.ground]
shape = "plane"
[camera.main]
eye = [0.0, 2.0, 4.0]
target = [0.0, 1.0, 0.0]
[[golden]]
frames = [4]
size = [160, 90]
)");
    return readScenarios({folder / "spring.toml"}, {}).scenarios.front();
}

CalibrationOptions options() {
    CalibrationOptions options;
    options.drawing.shaders = std::filesystem::path(TAUT_SOURCE_DIR) / "shaders";
    return options;
}

const report::CalibrationRow& rowOf(const std::vector<report::CalibrationRow>& rows, const std::string& what) {
    static const report::CalibrationRow none;
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.what == what; });
    EXPECT_NE(found, rows.end()) << what;
    return found == rows.end() ? none : *found;
}

const std::atomic<bool> goOn = false;

TEST(Calibration, FindsEveryMutantByTheTestMeantForIt) {
    const TemporaryFolder folder;
    const auto rows = calibrate({scenario(folder)}, options(), goOn);
    for (const report::CalibrationRow& row : rows) EXPECT_EQ(row.refusal, "") << row.what;
    EXPECT_FALSE(rowOf(rows, "again").pictureDiffers);
    EXPECT_FALSE(rowOf(rows, "again").stateDiffers);
    for (const char* mutant : {"dt × 2", "damping − 20 %", "one spring missing"})
        EXPECT_TRUE(rowOf(rows, mutant).stateDiffers) << mutant;
    // Its shadow is too small in the picture for a penumbra.
    for (const char* mutant : {"camera one pixel off", "sun − 2 %", "surroundings − 2 %", "shadow off"})
        EXPECT_TRUE(rowOf(rows, mutant).pictureDiffers) << mutant;
}

TEST(Calibration, RefusesThresholdsThatLetAMutantThrough) {
    const TemporaryFolder folder;
    CalibrationOptions loose = options();
    loose.tolerance = {255, 1.0, 255, 1.0, 255.0};
    const auto rows = calibrate({scenario(folder)}, loose, goOn);
    for (const char* mutant : {"camera one pixel off", "shadow off"})
        EXPECT_NE(rowOf(rows, mutant).refusal.find("let this through"), std::string::npos) << mutant;
    EXPECT_EQ(rowOf(rows, "again").refusal, "");
}

TEST(Calibration, RefusesThresholdsLessThanTwiceTheNoise) {
    const TemporaryFolder folder;
    CalibrationOptions noisy = options();
    // Another process that draws a picture with one of its 14400 pixels in 1200 off by ten: 0.083 %, which passes the
    // test, but less than twice below its threshold of 0.11 %.
    noisy.scratch = folder.path();
    noisy.drawApart = [](const Scenario& of, const GoldenRequest& golden, const Apart&,
                         const std::filesystem::path& png) {
        Drawer drawer(options().drawing);
        const std::atomic<bool> stop = false;
        const Played played = playScenario(of, drawer, {}, stop);
        image::Image picture = played.pictures.front().picture;
        for (std::size_t i = 0; i < picture.rgb.size(); i += 3600)
            picture.rgb[i] =
                static_cast<std::uint8_t>(picture.rgb[i] < 128 ? picture.rgb[i] + 10 : picture.rgb[i] - 10);
        EXPECT_EQ(golden.frame, 4);
        image::writePng(png, picture);
        return pipeline::hexadecimal(played.pictures.front().stateHash);
    };
    const auto rows = calibrate({scenario(folder)}, noisy, goOn);
    for (const char* process : {"1 thread", "4 threads", "SSE2", "SSE4.1", "AVX"}) {
        EXPECT_NE(rowOf(rows, process).refusal.find("less than 2 times this noise"), std::string::npos) << process;
        EXPECT_FALSE(rowOf(rows, process).pictureDiffers) << process;
        EXPECT_FALSE(rowOf(rows, process).stateDiffers) << process;
    }
}

// Without this the noise between processors would be measured as none.
TEST(Calibration, AProcessOfItsOwnDrawsAsAnOlderProcessorDoes) {
    const TemporaryFolder folder;
    scenario(folder);
    core::ChildCommand command{{TAUT_PROGRAM, "render", (folder / "spring.toml").string(), "-o",
                                (folder / "out").string(), "--frames", "0", "--size", "16x16", "--quiet"}};
    command.environment["GALLIUM_OVERRIDE_CPU_CAPS"] = "sse2";
    ASSERT_TRUE(core::runChild(command).end.succeeded());
    // The widest registers of SSE2; AVX has 256 bits.
    EXPECT_TRUE(test::has(test::contentOf(folder / "out/run_0-0.json"), "128 bits"));
}

// The changes of a mutant, and that it leaves a scene alone that has nothing of the kind.
TEST(Mutants, ChangeWhatTheySay) {
    const std::vector<Mutant> all = mutants();
    ASSERT_EQ(all.size(), 10U);
    world::SceneSpec nothing;
    for (const Mutant& mutant : all)
        if (mutant.isOfState()) EXPECT_FALSE(mutant.ofScene(nothing, {})) << mutant.name;
    world::SceneSpec cloth;
    cloth.bodies.add(world::ClothSpec{});
    cloth.bodies.of<world::ClothSpec>()[0].name = "c";
    cloth.materials["m"].dampingTime = 0.5;
    world::IslandInfo island;
    island.bodies = {"cloth.c"};
    island.substeps = 4;
    island.step = 0.01;
    EXPECT_GT(*all[0].ofScene(cloth, {island})->bodies.of<world::ClothSpec>()[0].solver.dt, 0.0199);
    island.substeps = 1;
    EXPECT_LT(*all[0].ofScene(cloth, {island})->bodies.of<world::ClothSpec>()[0].solver.dt, 0.0051);
    EXPECT_DOUBLE_EQ(all[1].ofScene(cloth, {})->materials["m"].dampingTime, 0.4);
    EXPECT_EQ(all[2].ofScene(cloth, {})->actions.size(), 1U);

    view::FrameView view;
    view.camera.eye = {0.0F, 0.0F, 10.0F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    all[3].ofView(view, {200, 100});
    // 10 m away a hundred pixels span 2 · 10 · tan(fov / 2).
    EXPECT_NEAR(view.camera.target.x, 0.2F * std::tan(0.35F), 1e-5);
    // One light at a time.
    view.lamps.resize(2);
    const glm::vec3 sun = view.light.colour, sky = view.light.sky;
    all[4].ofView(view, {200, 100});
    EXPECT_EQ(view.light.colour, 0.98F * sun);
    EXPECT_EQ(view.light.sky, sky);
    all[5].ofView(view, {200, 100});
    EXPECT_EQ(view.light.sky, 0.98F * sky);
    all[7].ofView(view, {200, 100});
    EXPECT_EQ(view.lamps[0].colour, glm::vec3(1.0F));
    EXPECT_EQ(view.lamps[1].colour, glm::vec3(0.98F));
    all[8].ofView(view, {200, 100});
    EXPECT_EQ(view.light.softness, 1.5F * view::Light{}.softness);
}

}  // namespace
}  // namespace taut::regression
