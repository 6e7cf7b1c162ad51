// The content of pictures, drawn with the real GL library.
#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

#include "render_support.h"
#include "taut/image/png.h"

namespace taut::render::test {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

// Dithering moves a value by half a step, rounding by another half.
constexpr int ditherStep = 1;

TEST(RenderPicture, BlankSceneIsTheGradient) {
    view::FrameView view;
    view.camera.eye = {0.0F, 1.0F, 5.0F};
    view.camera.target = {0.0F, 1.0F, 0.0F};
    const image::Image picture = pictureOf(view);
    ASSERT_EQ(picture.rgb.size(), 320U * 180U * 3U);
    for (int y = 0; y < 180; ++y) {
        const float slope = std::tan(0.5F * view.camera.fieldOfView) * (89.5F - static_cast<float>(y)) / 90.0F;
        for (const int x : {160, 3, 310}) {
            const float side = std::tan(0.5F * view.camera.fieldOfView) * (static_cast<float>(x) - 159.5F) / 90.0F;
            const float up = std::max(slope, 0.0F) / std::sqrt(1.0F + slope * slope + side * side);
            const float part = up * up / (up * up + 0.0064F);
            const glm::vec3 expected = glm::mix(view.background.horizon, view.background.top, part);
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(pixelAt(picture, x, y)[channel], srgb(expected[channel]), ditherStep + 0.5) << "row " << y;
        }
    }
}

TEST(RenderPicture, LinearColourIsEncodedAsSrgb) {
    for (const float linear : {0.002F, 0.05F, 0.18F, 0.5F, 0.9F}) {
        view::FrameView view;
        view.background.top = view.background.horizon = glm::vec3(linear, 0.5F * linear, linear);
        const Pixel pixel = pixelAt(pictureOf(view), 100, 50);
        EXPECT_NEAR(pixel[0], srgb(linear), ditherStep + 0.5);
        EXPECT_NEAR(pixel[1], srgb(0.5F * linear), ditherStep + 0.5);
    }
}

TEST(RenderPicture, FloorInKnownLightHasTheValueOfTheToneCurve) {
    view::FrameView view = floorView();
    view.light.colour = glm::vec3(0.8F * pi);
    view.light.sky = glm::vec3(0.1F);
    view.ground->colour = glm::vec3(0.4F);
    const Pixel pixel = pixelOf(pictureOf(view), view.camera, {0.0F, 0.0F, 0.0F});
    EXPECT_NEAR(pixel[1], srgb(filmic(0.4F * (0.8F + 0.1F))), ditherStep + 0.5);
}

// Squares of half a metre, whose corners meet at the origin.
TEST(RenderPicture, FloorWithAPatternHasItsColoursWhereTheyBelong) {
    view::FrameView view = floorView();
    view.light.colour = glm::vec3(0.8F * pi);
    view.light.sky = glm::vec3(0.1F);
    view::Finish finish;
    finish.pattern = view::Pattern::checker;
    finish.front = glm::vec3(0.4F);
    finish.accent = glm::vec3(0.1F);
    finish.repeat = 1.0F;
    view.ground->pattern = std::make_shared<const view::Finish>(finish);
    const image::Image picture = pictureOf(view);
    for (const auto& [x, z, colour] : {std::tuple(0.75F, 0.75F, 0.4F), {0.25F, 0.75F, 0.1F}, {-0.25F, -0.75F, 0.1F}})
        EXPECT_NEAR(pixelOf(picture, view.camera, {x, 0.0F, z})[1], srgb(filmic(colour * 0.9F)), ditherStep + 0.5);
}

TEST(RenderPicture, CameraMayLookStraightDown) {
    view::FrameView view = floorView();
    view.light.colour = glm::vec3(0.8F * pi);
    view.light.sky = glm::vec3(0.1F);
    view.ground->colour = glm::vec3(0.4F);
    view.camera.eye = {0.0F, 3.0F, 0.0F};
    const Pixel pixel = pixelAt(pictureOf(view), 200, 120);
    EXPECT_NEAR(pixel[1], srgb(filmic(0.4F * (0.8F + 0.1F))), ditherStep + 0.5);
}

// From 250 m away the ground 60 m from the target is as it is near, and a thing 300 m off is not cut away.
TEST(RenderPicture, TheGroundOfALargeSceneFadesFurtherAway) {
    view::FrameView view = floorView();
    view.camera.eye = {0.0F, 150.0F, 200.0F};
    const image::Image picture = pictureOf(view);
    const Pixel near = pixelOf(picture, view.camera, {0.0F, 0.0F, 0.0F});
    const Pixel sky = pixelAt(pictureOf([&] {
                                  view::FrameView blank = view;
                                  blank.ground.reset();
                                  return blank;
                              }()),
                              200, 120);
    EXPECT_GT(std::abs(brightness(near) - brightness(sky)), 60);
    EXPECT_NEAR(brightness(pixelOf(picture, view.camera, {0.0F, 0.0F, -60.0F})), brightness(near), 6);
    view.background.fadesWithCamera = false;
    const image::Image small = pictureOf(view);
    EXPECT_NEAR(brightness(pixelOf(small, view.camera, {0.0F, 0.0F, -60.0F})), brightness(sky), 6);
}

TEST(RenderPicture, ShadowLiesWhereTheLightSaysItDoes) {
    view::FrameView view = floorView();
    view.light.direction = {1.0F, -1.0F, 0.0F};  // a metre high is a metre to the right
    view.surfaces.push_back(surface(view::boxMesh({0.3F, 0.05F, 0.3F}, 0.0F), {-0.5F, 1.0F, 0.0F}, glm::vec3(0.5F)));
    const image::Image picture = pictureOf(view);
    const auto floorAt = [&](float x, float z) { return brightness(pixelOf(picture, view.camera, {x, 0.0F, z})); };
    const int lit = floorAt(2.0F, 0.0F);
    const int dark = floorAt(0.5F, 0.0F);
    EXPECT_LT(dark, lit / 2 + 60);  // sky light is left: about a quarter of the light, half of the sRGB value
    // The box's shadow reaches from 0.15 (its lower left edge) to 0.85 and 0.3 to each side; the penumbra is 4 cm.
    for (const float x : {0.21F, 0.5F, 0.79F}) EXPECT_NEAR(floorAt(x, 0.0F), dark, 12) << x;
    for (const float x : {0.09F, 0.91F}) EXPECT_NEAR(floorAt(x, 0.0F), lit, 12) << x;
    for (const float z : {-0.36F, 0.36F}) EXPECT_NEAR(floorAt(0.5F, z), lit, 12) << z;
    for (const float z : {-0.24F, 0.24F}) EXPECT_NEAR(floorAt(0.5F, z), dark, 12) << z;
}

// Within the reach of shaders/nearby.frag, 0.3 m, and in the picture.
TEST(RenderPicture, WallTakesSkyFromASurfaceBesideIt) {
    view::FrameView view = floorView();
    view.light.colour = glm::vec3(0.0F);
    static const view::Mesh slab = view::boxMesh({1.0F, 0.1F, 1.0F}, 0.0F),
                            wall = view::boxMesh({1.0F, 0.3F, 0.05F}, 0.0F);
    view.surfaces.push_back(surface(slab, {0.0F, 0.1F, 0.0F}, glm::vec3(0.8F)));
    view.surfaces.push_back(surface(wall, {0.0F, 0.5F, -0.3F}, glm::vec3(0.8F)));
    RendererOptions options = smallOptions();
    const image::Image with = pictureOf(view, options);
    options.occlusion = false;
    const image::Image without = pictureOf(view, options);
    const auto shareLeft = [&](glm::vec3 place) {
        return lightOf(pixelOf(with, view.camera, place)[1]) / lightOf(pixelOf(without, view.camera, place)[1]);
    };
    EXPECT_LT(shareLeft({0.0F, 0.2F, -0.2F}), 0.9F);
    EXPECT_GT(shareLeft({0.0F, 0.2F, -0.2F}), 0.4F);
    EXPECT_NEAR(shareLeft({0.0F, 0.2F, 0.5F}), 1.0F, 0.02F);  // a byte
}

TEST(RenderPicture, SurfaceInShadowIsDarkerThanTheSameInLight) {
    view::FrameView view = floorView();
    view.surfaces.push_back(surface(view::quadMesh({0.0F, 1.0F, 0.0F}, 0.5F), {0.8F, 0.5F, 0.0F}, glm::vec3(0.5F)));
    view.surfaces.push_back(surface(view::quadMesh({0.0F, 1.0F, 0.0F}, 0.5F), {-0.8F, 0.5F, 0.0F}, glm::vec3(0.5F)));
    view.surfaces.push_back(surface(view::boxMesh({0.4F, 0.1F, 0.4F}, 0.0F), {0.8F, 2.8F, 0.0F}, glm::vec3(0.5F)));
    const image::Image picture = pictureOf(view);
    const int shaded = brightness(pixelOf(picture, view.camera, {0.8F, 0.5F, 0.0F}));
    const int lit = brightness(pixelOf(picture, view.camera, {-0.8F, 0.5F, 0.0F}));
    EXPECT_LT(shaded, lit - 100);  // a quarter of the light is some 40 % of the sRGB value, here over 500
}

TEST(RenderPicture, LitSurfaceDoesNotShadeItself) {
    // Light from 10 degrees above the surface: the worst case for a map's resolution. All of it has one brightness.
    view::FrameView view = floorView();
    view.light.direction = {1.0F, -0.18F, 0.1F};
    view.surfaces.push_back(surface(view::quadMesh({0.0F, 1.0F, 0.0F}, 1.0F), {0.0F, 0.3F, 0.0F}, glm::vec3(0.7F)));
    const image::Image picture = pictureOf(view);
    const int middle = brightness(pixelOf(picture, view.camera, {0.0F, 0.3F, 0.0F}));
    for (float x = -0.9F; x < 0.95F; x += 0.1F) {
        for (float z = -0.9F; z < 0.95F; z += 0.1F) {
            // Gloss at grazing light differs a little over the surface; a spot of shadow would be 100 darker.
            EXPECT_NEAR(brightness(pixelOf(picture, view.camera, {x, 0.3F, z})), middle, 25) << x << ", " << z;
        }
    }
}

TEST(RenderPicture, ClothShowsADifferentColourOnItsBack) {
    view::FrameView view;
    view.camera.eye = {0.0F, 1.0F, 3.0F};
    view.light.direction = {0.0F, -1.0F, -1.0F};
    view::Surface cloth = surface(view::quadMesh({0.0F, 0.0F, 1.0F}, 0.5F), {0.0F, 1.0F, 0.0F}, {0.8F, 0.05F, 0.05F});
    view::Finish finish = *cloth.finish;
    finish.back = {0.05F, 0.05F, 0.8F};
    cloth.finish = std::make_shared<const view::Finish>(finish);
    cloth.twoSided = true;
    view.surfaces.push_back(cloth);
    const Pixel front = pixelAt(pictureOf(view), 160, 90);
    view.camera.eye.z = -3.0F;
    view.light.direction.z = 1.0F;
    const Pixel back = pixelAt(pictureOf(view), 160, 90);
    EXPECT_GT(front[0], front[2] + 80);
    EXPECT_GT(back[2], back[0] + 80);
}

TEST(RenderPicture, ClothLitFromBehindLetsSomeLightThrough) {
    view::FrameView view;
    view.camera.eye = {0.0F, 1.0F, 3.0F};
    view.light.sky = view.light.ground = glm::vec3(0.0F);
    view.light.direction = {0.0F, -0.2F, 1.0F};  // towards the camera
    view::Surface sheet = surface(view::quadMesh({0.0F, 0.0F, 1.0F}, 0.5F), {0.0F, 1.0F, 0.0F}, glm::vec3(0.8F));
    view.surfaces = {sheet};
    const int opaque = brightness(pixelAt(pictureOf(view), 160, 90));
    view.surfaces[0].twoSided = true;
    const int cloth = brightness(pixelAt(pictureOf(view), 160, 90));
    EXPECT_LT(opaque, 10);
    EXPECT_GT(cloth, 100);
}

// Grey levels along the edge of a slanted bright board before a black background.
int intermediateLevels(int samples) {
    view::FrameView view;
    view.camera.eye = {0.0F, 1.0F, 3.0F};
    view.background.top = view.background.horizon = glm::vec3(0.0F);
    view.surfaces.push_back(surface(view::quadMesh({0.0F, 0.0F, 1.0F}, 0.6F), {0.0F, 1.0F, 0.0F}, glm::vec3(0.9F)));
    view.surfaces[0].transform = glm::rotate(view.surfaces[0].transform, 0.2F, {0.0F, 0.0F, 1.0F});
    view.light.direction = {0.0F, 0.0F, -1.0F};
    RendererOptions options = smallOptions();
    options.samples = samples;
    const image::Image picture = pictureOf(view, options);
    const int full = pixelAt(picture, 160, 90)[1];
    int between = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int value = pixelAt(picture, x, y)[1];
            if (value > 20 && value < full - 20) ++between;
        }
    }
    return between;
}

TEST(RenderPicture, FourSamplesGiveEdgesIntermediateValues) {
    EXPECT_EQ(intermediateLevels(1), 0);
    // About 4 · 60 pixels of edge, of which most are partly covered.
    EXPECT_GT(intermediateLevels(4), 100);
}

TEST(RenderPicture, EdgesAreAveragedAsLight) {
    // Half covered, white on black: 188 of 255, not 128. Steps of a quarter: 137, 188, 225 of white.
    view::FrameView view;
    view.camera.eye = {0.0F, 1.0F, 3.0F};
    view.background.top = view.background.horizon = glm::vec3(0.0F);
    view.surfaces.push_back(surface(view::quadMesh({0.0F, 0.0F, 1.0F}, 0.6F), {0.0F, 1.0F, 0.0F}, glm::vec3(0.9F)));
    view.surfaces[0].transform = glm::rotate(view.surfaces[0].transform, 0.2F, {0.0F, 0.0F, 1.0F});
    view.light.direction = {0.0F, 0.0F, -1.0F};
    const image::Image picture = pictureOf(view);
    const auto full = static_cast<float>(pixelAt(picture, 160, 90)[1]);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto value = static_cast<float>(pixelAt(picture, x, y)[1]);
            if (value < 3.0F || value > full - 6.0F) continue;
            float nearest = 255.0F;
            for (const float part : {0.25F, 0.5F, 0.75F})
                nearest = std::min(nearest, std::abs(value - full * std::sqrt(part)));
            // The square stands for the sRGB curve; the colour varies by a few steps over the board.
            EXPECT_LT(nearest, 8.0F) << value;
        }
    }
}

// A board upright before the camera, with a texture half red, half blue.
view::FrameView texturedView(const std::filesystem::path& file) {
    image::writePng(file, {2, 1, {255, 0, 0, 0, 0, 255}});
    view::FrameView view = floorView();
    view.light.direction = {0.0F, -0.5F, -1.0F};
    view::Surface board = surface(view::quadMesh({0.0F, 0.0F, 1.0F}, 0.5F), {0.0F, 0.5F, 0.0F}, glm::vec3(0.8F));
    view::Finish finish = *board.finish;
    finish.pattern = view::Pattern::image;
    finish.repeat = 0.5F;
    finish.texture = file;
    board.finish = std::make_shared<const view::Finish>(finish);
    view.surfaces.push_back(board);
    return view;
}

TEST(RenderPicture, ImagePatternShowsThePicture) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "render_texture.png";
    const view::FrameView view = texturedView(file);
    const image::Image picture = pictureOf(view);
    int red = 0;
    int blue = 0;
    for (float x = -0.45F; x < 0.46F; x += 0.03F) {
        const Pixel pixel = pixelOf(picture, view.camera, {x, 0.5F, 0.0F});
        if (pixel[0] > pixel[2] + 60) ++red;
        if (pixel[2] > pixel[0] + 60) ++blue;
    }
    EXPECT_GT(red, 5);
    EXPECT_GT(blue, 5);
    std::filesystem::remove(file);
}

TEST(RenderPicture, ReadingATextureChangesNothingElse) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "render_texture_twice.png";
    const view::FrameView view = texturedView(file);
    Renderer renderer(smallOptions());
    const image::Image first = renderer.draw(view);
    EXPECT_EQ(renderer.draw(view).rgb, first.rgb);
    std::filesystem::remove(file);
}

TEST(RenderPicture, MarksAreDrawnInTheDebugViewOnly) {
    view::FrameView view;
    view.camera.eye = {0.0F, 1.0F, 3.0F};
    view.marks.lines.push_back({{-0.5F, 1.0F, 0.0F}, {0.5F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}});
    view.marks.dots.push_back({{0.0F, 1.3F, 0.0F}, {0.0F, 1.0F, 0.0F}, 20.0F});
    view.marks.lines.push_back({{0.0F, 1.0F, 9.0F}, {0.1F, 1.0F, 2.0F}, {1.0F, 0.0F, 0.0F}});  // from behind the eye
    const image::Image plain = pictureOf(view);
    view.showMarks = true;
    const image::Image marked = pictureOf(view);
    const Pixel dot = pixelOf(marked, view.camera, {0.0F, 1.3F, 0.0F});
    EXPECT_GT(dot[1], dot[0] + 60);
    int reddest = 0;
    for (int y = 87; y < 93; ++y) reddest = std::max(reddest, pixelAt(marked, 140, y)[0] - pixelAt(marked, 140, y)[1]);
    EXPECT_GT(reddest, 60);
    EXPECT_LT(pixelAt(plain, 140, 90)[0], pixelAt(plain, 140, 90)[1] + 10);
}

}  // namespace
}  // namespace taut::render::test
