// The rules of the goldens of this folder. That the scenarios agree with their goldens is a test of its own, `taut
// test assets/scenarios`.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "taut/image/private/compare.h"
#include "taut/regression/manifest.h"
#include "taut/render/renderer.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut {
namespace {

const std::filesystem::path source = TAUT_SOURCE_DIR;
const regression::GoldenFolder folder{source / "tests/golden"};

TEST(Goldens, ThereAreSomeOfEveryShippedSceneAndScenario) {
    const regression::Manifest manifest = regression::readManifest(folder);
    for (const char* kind : {"scenes", "scenarios"})
        for (const auto& entry : std::filesystem::directory_iterator(source / "assets" / kind)) {
            if (entry.path().extension() != ".toml") continue;
            const auto known = manifest.scenarios.find(entry.path().stem());
            ASSERT_NE(known, manifest.scenarios.end()) << entry.path();
            EXPECT_TRUE(known->second.state) << entry.path();
        }
}

TEST(Goldens, AreNamedInTheManifestAndHaveAReason) {
    const regression::Manifest manifest = regression::readManifest(folder);
    std::set<std::filesystem::path> named;
    for (const auto& [scenario, goldens] : manifest.scenarios) {
        if (goldens.state) {
            named.insert(folder.tape(scenario));
            EXPECT_GT(goldens.state->why.size(), 10U) << scenario;
        }
        for (const auto& [key, picture] : goldens.pictures) {
            named.insert(folder.picture(scenario, key));
            named.insert(folder.stored(scenario, key));  // of pictures that start from one
            EXPECT_TRUE(std::filesystem::exists(folder.picture(scenario, key))) << scenario << " " << key;
            EXPECT_GT(picture.why.size(), 10U) << scenario << " " << key;
        }
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path)) {
        const std::string extension = entry.path().extension();
        if (extension == ".png" || extension == ".tape" || extension == ".state")
            EXPECT_TRUE(named.contains(entry.path())) << entry.path();
    }
}

// The comment of the tolerance, and the calibration, are about this one.
TEST(Goldens, AreComparedWithTheToleranceThatIsJustified) {
    EXPECT_EQ(regression::readManifest(folder).tolerance, image::Tolerance{});
    EXPECT_EQ(regression::readManifest(folder).otherRenderer, image::betweenRenderers);
}

// The purpose of the tolerance: a shadow switched off, a camera moved by a pixel, a colour off by a shade must fail.
TEST(Goldens, FindMistakesInAPicture) {
    scene::LoadOptions load;
    load.overrides = {"picture.size=[640, 360]"};
    load.assetFolders = {source / "assets"};
    const world::World world(scene::loadScene(source / "assets/scenes/drape.toml", load).spec);
    const view::FrameView right = world.view(false);
    render::RendererOptions options;
    options.width = 640;
    options.height = 360;
    options.shaders = source / "shaders";
    render::Renderer renderer(options);
    options.shadows = false;
    render::Renderer shadowless(options);
    const image::Image expected = renderer.draw(right);
    const image::Tolerance tolerance = regression::readManifest(folder).tolerance;
    const auto isFound = [&](render::Renderer& by, void (*spoil)(view::FrameView&)) {
        view::FrameView view = right;
        spoil(view);
        return !image::compare(expected, by.draw(view), tolerance).within;
    };
    const auto nothing = [](view::FrameView&) {};
    EXPECT_FALSE(isFound(renderer, nothing));
    EXPECT_TRUE(isFound(shadowless, nothing));
    EXPECT_TRUE(isFound(
        renderer,
        [](view::FrameView& view) {
            view.light.direction = {0.0F, -1.0F, 0.0F};
        }));
    EXPECT_TRUE(isFound(
        renderer, [](view::FrameView& view) { view.light.sky *= 1.05F; }));
    EXPECT_TRUE(isFound(
        renderer, [](view::FrameView& view) { view.camera.fieldOfView *= 1.005F; }));
    EXPECT_TRUE(isFound(
        renderer,
        [](view::FrameView& view) {
            view.camera.target.x += glm::length(view.camera.eye - view.camera.target) * 0.002F;
        }));
    EXPECT_TRUE(isFound(renderer, [](view::FrameView& view) { view.surfaces.pop_back(); }));
}

}  // namespace
}  // namespace taut
