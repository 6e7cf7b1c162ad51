// Light from a picture of all that is around. Expected numbers are integrals over the sphere, done by hand.
#include "taut/render/private/environment.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "image_support.h"
#include "render_support.h"
#include "taut/core/error.h"
#include "taut/image/png.h"

namespace taut::render::test {
namespace {

using taut::test::messageOf;
using taut::test::TemporaryFolder;

// By the direction of each pixel's middle.
image::LightImage around(int height, const std::function<glm::vec3(glm::vec3)>& light) {
    image::LightImage picture{2 * height, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 2 * height; ++x) {
            const float step = std::numbers::pi_v<float> / static_cast<float>(height);
            const float down = step * (static_cast<float>(y) + 0.5F);
            const float turn = step * (static_cast<float>(x) + 0.5F - static_cast<float>(height));
            const glm::vec3 seen =
                light({std::sin(down) * std::sin(turn), std::cos(down), -std::sin(down) * std::cos(turn)});
            picture.rgb.insert(picture.rgb.end(), {seen.x, seen.y, seen.z});
        }
    return picture;
}

// A sky of 1 over black: (1 + cos) / 2 of it, at any angle, and as much to the second order. Red shines from the right
// half, green from above, blue from behind (+z).
TEST(Environment, LightsASurfaceAsAHalfSkyDoes) {
    const AmbientLight light = ambientLight(around(128, [](glm::vec3 way) {
        return glm::vec3(way.x > 0.0F ? 1.0F : 0.0F, way.y > 0.0F ? 1.0F : 0.0F, way.z > 0.0F ? 1.0F : 0.0F);
    }));
    for (const glm::vec3 way :
         {glm::vec3(0.0F, 1.0F, 0.0F), {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -1.0F}, {0.6F, -0.64F, 0.48F}})
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(light.on(way)[i], 0.5F + 0.5F * way[i], 5e-4F);  // a pixel is 25 mrad: (25e-3)² / 2 of error
}

// E / π for light of (3 y² - 1) / 2 is a quarter of that (Ramamoorthi and Hanrahan 2001, eq. 8), and 1 / 4 in the
// directions of x z and x² - z².
TEST(Environment, LightOfTheSecondOrderKeepsAQuarter) {
    const auto shine = [](glm::vec3 w) {
        return glm::vec3(1.0F + w.x * w.z, 1.0F + w.x * w.x - w.z * w.z, 0.5F + 1.5F * w.y * w.y);
    };
    const AmbientLight light = ambientLight(around(128, shine));
    const glm::vec3 way(0.6F, 0.64F, 0.48F);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(light.on(way)[i], 1.0F + 0.25F * (shine(way)[i] - 1.0F), 1e-3F);
}

// All light of a picture stays in each smaller one; near the poles a texel takes in all around.
TEST(Environment, LevelsAreBlurredEvenlyInAngle) {
    const auto levels =
        blurredLevels(around(64, [](glm::vec3 way) { return glm::vec3(way.x > 0.0F ? 2.0F : 0.0F); }), 64);
    ASSERT_EQ(levels.size(), 4U);
    EXPECT_EQ(levels.front().width, 64);
    EXPECT_EQ(levels.back().width, 8);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        double mean = 0.0;
        for (const float value : levels[i].rgb) mean += value / static_cast<double>(levels[i].rgb.size());
        EXPECT_NEAR(mean, 1.0, 1e-5);
    }
    // A texel of the second level's first row stands for 1 / sin(π / 32) = 10.2 of its 32. The one left of where the
    // light begins takes in the light up to 4.6 to the right of there, the one beside it 5.6.
    const double width = 1.0 / std::sin(std::numbers::pi / 32.0);
    EXPECT_NEAR(levels[1].rgb[3 * 15], 2.0 * (0.5 * width - 0.5) / width, 1e-5);
    EXPECT_NEAR(levels[1].rgb[3 * 16], 2.0 * (0.5 * width + 0.5) / width, 1e-5);
}

// A room of one colour is a sky and a ground of that colour: on a ball and a floor nothing else can be seen of it.
TEST(Environment, AnEvenRoomLightsAsAnEvenSky) {
    const TemporaryFolder folder;
    image::Image room{64, 32, {}, {}};
    for (int i = 0; i < 64 * 32; ++i) room.rgb.insert(room.rgb.end(), {188, 150, 90});
    image::writePng(folder / "room.png", room);
    view::FrameView view = floorView();
    view.surfaces = {surface(view::sphereMesh(0.5F), {0.0F, 0.8F, 0.0F}, {0.8F, 0.5F, 0.3F})};
    view.light.sky = view.light.ground = {0.5029F, 0.3050F, 0.1022F};  // of these bytes, IEC 61966-2-1
    const image::Image plain = pictureOf(view);
    view.environment = view::Environment{(folder / "room.png").string(), 1.0F, 0.7F, false};
    const image::Image lit = pictureOf(view);
    for (std::size_t i = 0; i < plain.rgb.size(); ++i) ASSERT_NEAR(plain.rgb[i], lit.rgb[i], 1) << i;

    // Behind it all the room is seen as light, by the same tone curve as everything.
    view.environment->isShown = true;
    view.camera.eye.y = 0.5F;
    view.camera.target.y = 1.5F;
    const Pixel sky = pixelAt(pictureOf(view), 20, 20);
    EXPECT_NEAR(sky[0], srgb(filmic(0.5029F)), 1.5F);
    EXPECT_NEAR(sky[2], srgb(filmic(0.1022F)), 1.5F);
}

// The picture's middle lies straight ahead at -z, its right at +x, its upper edge above; a turn takes it to the left.
TEST(Environment, IsSeenWhereItLies) {
    const TemporaryFolder folder;
    image::Image room{512, 256, std::vector<std::uint8_t>(3 * 512 * 256, 0), {}};
    const auto paint = [&](int x, int y, std::size_t channel) {
        for (int j = y - 8; j < y + 8; ++j)
            for (int i = x - 8; i < x + 8; ++i) room.rgb[3 * static_cast<std::size_t>(j * 512 + i) + channel] = 255;
    };
    paint(256, 128, 0);             // ahead
    paint(256 + 512 / 16, 128, 1);  // 22.5° to the right
    paint(256, 128 - 256 / 16, 2);  // 11.25° up
    image::writePng(folder / "room.png", room);
    view::FrameView view;
    view.camera.eye = {0.0F, 1.0F, 0.0F};
    view.camera.target = {0.0F, 1.0F, -1.0F};
    view.environment = view::Environment{(folder / "room.png").string()};
    const float turn = std::numbers::pi_v<float> / 8.0F;
    const auto seen = [&](float right, float up) {
        return pixelOf(pictureOf(view), view.camera, glm::vec3(std::tan(right), 1.0F + std::tan(up), -1.0F));
    };
    const auto isOnly = [](const Pixel& pixel, std::size_t channel) {
        for (std::size_t i = 0; i < 3; ++i)
            if ((pixel[i] > 150) != (i == channel) || (i != channel && pixel[i] > 20)) return false;
        return true;
    };
    EXPECT_TRUE(isOnly(seen(0.0F, 0.0F), 0));
    EXPECT_TRUE(isOnly(seen(turn, 0.0F), 1));
    EXPECT_TRUE(isOnly(seen(0.0F, 0.5F * turn), 2));
    view.environment->turn = turn;
    EXPECT_TRUE(isOnly(seen(0.0F, 0.0F), 1));
}

TEST(Environment, APictureOfAnotherShapeIsRefused) {
    const TemporaryFolder folder;
    image::writePng(folder / "wide.png", {3, 2, std::vector<std::uint8_t>(18), {}});
    view::FrameView view = floorView();
    view.environment = view::Environment{(folder / "wide.png").string()};
    const std::string message = messageOf(core::ErrorKind::badContent, [&] { pictureOf(view); });
    EXPECT_NE(message.find("wide.png: this picture has 3 x 2 pixels; one of all"), std::string::npos) << message;
}

}  // namespace
}  // namespace taut::render::test
