// Frames of the shipped scenes against the pictures kept in frames/, by the two-rule tolerance of image/compare.h.
// manifest.json names them, says why each looks as it does, and which renderer drew them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cinttypes>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "image/compare.h"
#include "image/png.h"
#include "image/read.h"
#include "pipeline/self_test.h"
#include "render/renderer.h"
#include "scene/load.h"
#include "world/world.h"

namespace taut {
namespace {

const std::filesystem::path source = TAUT_SOURCE_DIR;
const std::filesystem::path folder = source / "tests/golden";

struct Golden {
    std::string scene;
    int frame = 0;
    bool debug = false;
    std::string hash;  // of the state that it shows
    std::string name() const { return scene + (debug ? "_debug_" : "_") + std::to_string(frame); }
};

void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.name(); }

nlohmann::json manifest() {
    std::ifstream file(folder / "manifest.json");
    return nlohmann::json::parse(file);
}

std::vector<Golden> goldens() {
    std::vector<Golden> all;
    const nlohmann::json list = manifest().at("frames");
    for (const auto& entry : list)
        all.push_back({entry.at("scene"), entry.at("frame"), entry.value("debug", false), entry.at("hash")});
    return all;
}

std::unique_ptr<world::World> worldAt(const Golden& golden, const world::SceneSpec& spec) {
    auto world = std::make_unique<world::World>(spec);
    for (int tick = 0; tick < golden.frame * world->ticksPerFrame(); ++tick)
        if (const auto divergence = world->advance()) ADD_FAILURE() << divergence->message;
    return world;
}

class GoldenFrame : public testing::TestWithParam<Golden> {};

// A state that differs is told apart from a picture that does: the recorded hash decides.
TEST_P(GoldenFrame, IsWhatThisBuildDraws) {
    const Golden golden = GetParam();
    scene::LoadOptions load;
    load.overrides = {"picture.size=[640, 360]"};
    load.assetFolders = {source / "assets"};
    const world::SceneSpec spec = scene::loadScene(source / "assets/scenes" / (golden.scene + ".toml"), load).spec;
    const auto world = worldAt(golden, spec);
    char hash[17];
    std::snprintf(hash, sizeof hash, "%016" PRIx64, world->stateHash());
    EXPECT_EQ(golden.hash, hash) << "the state differs, so the picture may";

    render::RendererOptions options;
    options.width = 640;
    options.height = 360;
    options.samples = spec.picture.samples;
    options.shadowSize = spec.picture.shadowSize;
    options.shaders = source / "shaders";
    render::Renderer renderer(options);
    const image::Image actual = renderer.draw(world->view(golden.debug));

    const std::filesystem::path out = source / "out/golden";
    std::filesystem::create_directories(out);
    const std::filesystem::path actualFile = out / (golden.name() + ".png");
    const std::filesystem::path goldenFile = folder / "frames" / (golden.name() + ".png");
    image::writePng(actualFile, actual);
    const std::string accept = "\nWhere the change is meant: cp " + actualFile.string() + " " + goldenFile.string() +
                               "\nand say why in the entry's \"why\" in tests/golden/manifest.json.";
    ASSERT_TRUE(std::filesystem::exists(goldenFile)) << "no golden picture" << accept;
    const image::Image expected = image::readImage(goldenFile);
    const image::Comparison comparison = image::compare(expected, actual);
    if (!comparison.within && comparison.sameSize)
        image::writePng(out / (golden.name() + "_difference.png"), image::differencePicture(expected, actual));
    EXPECT_TRUE(comparison.within) << image::describe(comparison) << accept << "\nGoldens drawn by "
                                   << manifest().at("renderer") << ", this one by " << renderer.info().renderer << " "
                                   << renderer.info().version;
}

INSTANTIATE_TEST_SUITE_P(Shipped, GoldenFrame, testing::ValuesIn(goldens()),
                         [](const auto& golden) { return golden.param.name(); });

TEST(GoldenManifest, HasAFrameOfEveryShippedSceneAndAReasonForEach) {
    const std::vector<Golden> all = goldens();
    for (const auto& entry : std::filesystem::directory_iterator(source / "assets/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        const std::string scene = entry.path().stem();
        EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Golden& g) { return g.scene == scene; })) << scene;
    }
    const nlohmann::json list = manifest().at("frames");
    for (const auto& entry : list) EXPECT_GT(entry.at("why").get<std::string>().size(), 10U);
}

// What the tolerance is for: a shadow switched off, a camera moved by a pixel, a colour off by a shade must fail.
class Mutant : public testing::TestWithParam<const char*> {};

TEST_P(Mutant, IsFound) {
    scene::LoadOptions load;
    load.overrides = {"picture.size=[640, 360]"};
    load.assetFolders = {source / "assets"};
    const world::SceneSpec spec = scene::loadScene(source / "assets/scenes/drape.toml", load).spec;
    const world::World world(spec);
    view::FrameView view = world.view(false);
    render::RendererOptions options;
    options.width = 640;
    options.height = 360;
    options.shaders = source / "shaders";
    render::Renderer renderer(options);
    const image::Image right = renderer.draw(view);
    const std::string mutant = GetParam();
    if (mutant == "light") view.light.direction = {0.0F, -1.0F, 0.0F};
    if (mutant == "camera") view.camera.target.x += glm::length(view.camera.eye - view.camera.target) * 0.002F;
    if (mutant == "field") view.camera.fieldOfView *= 1.005F;
    if (mutant == "ambient") view.light.sky *= 1.05F;
    if (mutant == "missing") view.surfaces.pop_back();
    EXPECT_FALSE(image::compare(right, renderer.draw(view)).within) << mutant;
}

INSTANTIATE_TEST_SUITE_P(Goldens, Mutant, testing::Values("light", "camera", "field", "ambient", "missing"));

}  // namespace
}  // namespace taut
