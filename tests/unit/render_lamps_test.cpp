// The effect of several lights together, and of the size of one, from the theory of light alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <numeric>
#include <vector>

#include "render_support.h"

namespace taut::render::test {
namespace {

// A ball and a sheet that is lit through, on a floor without end, in slanted light.
view::FrameView litView() {
    view::FrameView view = floorView();
    view.background.fadeStart = 80.0F;
    view.background.fadeEnd = 90.0F;
    view.light.direction = {0.5F, -1.0F, -0.3F};
    view.light.colour = {1.2F, 0.9F, 0.6F};
    view.surfaces = {surface(view::sphereMesh(0.5F), {-0.6F, 0.5F, 0.0F}, {0.5F, 0.3F, 0.2F}),
                     surface(view::quadMesh({0.3F, 0.6F, 0.5F}, 0.5F), {0.7F, 0.8F, 0.0F}, {0.2F, 0.3F, 0.5F})};
    view.surfaces[1].twoSided = true;
    view::Finish woven = *view.surfaces[1].finish;
    woven.weave = 0.5F;
    woven.sheen = 0.4F;
    woven.roughness = 0.3F;
    view.surfaces[1].finish = std::make_shared<const view::Finish>(woven);
    return view;
}

RendererOptions lampOptions() {
    RendererOptions options = smallOptions();
    options.samples = 1;
    options.shadowSize = 512;
    return options;
}

int largestDifference(const image::Image& a, const image::Image& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
    return largest;
}

// Within the last bit of each byte: other programs may round otherwise.
TEST(RenderLamps, ALampInTheSunsPlaceDrawsWhatTheSunDoes) {
    for (const float softness : {0.03F, 0.2F}) {
        for (const bool hasShadow : {true, false}) {
            view::FrameView view = litView();
            view.light.softness = softness;
            RendererOptions options = lampOptions();
            options.shadows = hasShadow;
            const image::Image bySun = pictureOf(view, options);
            view.lamps = {{"a", view.light.direction, view.light.colour, softness, hasShadow}};
            view.light.colour = glm::vec3(0.0F);
            options.shadows = true;
            EXPECT_LE(largestDifference(bySun, pictureOf(view, options)), 1) << softness << hasShadow;
        }
    }
}

// Bytes of each picture are off by up to half a step, and by half a step of noise on the ground: three of them and
// their sum by four steps of that, of which one at the sum is the smallest, for both curves are steepest at 0.
TEST(RenderLamps, TheLightOfThreeAddsUp) {
    view::FrameView view = litView();
    view.light.sky = view.light.ground = glm::vec3(0.0F);
    const std::vector<glm::vec3> colours{view.light.colour, {0.3F, 1.0F, 0.4F}, {0.4F, 0.3F, 1.4F}};
    Renderer renderer(lampOptions());
    const auto litBy = [&](const std::vector<bool>& isOn) {
        const auto colour = [&](std::size_t i) { return isOn[i] ? colours[i] : glm::vec3(0.0F); };
        view.light.colour = colour(0);
        view.lamps = {{"a", {-0.6F, -0.5F, -0.2F}, colour(1), 0.1F, true},
                      {"b", {0.2F, -1.0F, 0.7F}, colour(2), 0.0F, true}};
        return renderer.draw(view);
    };
    const image::Image all = litBy({true, true, true});
    const image::Image one = litBy({true, false, false}), two = litBy({false, true, false}),
                       three = litBy({false, false, true});
    int worst = 0, lit = 0;
    for (int y = 60; y < all.height; ++y) {  // below the horizon
        for (int x = 0; x < all.width; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                const auto at = [&](const image::Image& picture) { return pixelAt(picture, x, y)[c]; };
                if (at(all) > 245) continue;  // where curves are flat
                const float sum = lightOf(at(one)) + lightOf(at(two)) + lightOf(at(three));
                worst = std::max(worst, static_cast<int>(std::fabs(srgb(filmic(sum)) - static_cast<float>(at(all)))));
                lit += at(one) > 20 && at(two) > 20 && at(three) > 20 ? 1 : 0;
            }
        }
    }
    EXPECT_LE(worst, 4);
    EXPECT_GT(lit, 20000);  // of 115200
}

// A roof of which one edge runs across the picture, 1 m above the ground. Behind it the light f grows from 0 to 1 as
// the part of a disc that has come out from behind a straight edge. The sum of f (1 - f) over that is 128 / (45 π²) of
// the disc's radius.
float penumbraOf(float softness) {
    view::FrameView view = floorView();
    view.camera.eye = {0.0F, 0.9F, 1.2F};
    view.light.direction = {0.0F, -1.0F, 0.0F};
    view.light.softness = softness;
    view.surfaces = {surface(view::boxMesh({1.0F, 0.002F, 2.0F}, 0.0F), {-1.0F, 1.0F, 0.0F}, glm::vec3(0.5F))};
    RendererOptions options = lampOptions();
    options.width = 640;
    options.height = 360;
    options.shadowSize = 1024;
    options.occlusion = false;
    const image::Image picture = pictureOf(view, options);
    constexpr float step = 0.002F;
    std::vector<float> light;
    for (float x = -0.6F; x < 0.6F; x += step) {
        light.push_back(0.0F);
        for (float z = -0.1F; z < 0.1F; z += 0.004F)
            light.back() += lightOf(pixelOf(picture, view.camera, {x, 0.0F, z})[1]);
    }
    const auto meanOf = [](auto begin) { return std::accumulate(begin, begin + 50, 0.0F) / 50.0F; };
    const float dark = meanOf(light.begin()), open = meanOf(light.end() - 50);
    float sum = 0.0F;
    for (const float here : light) {
        const float f = (here - dark) / (open - dark);
        sum += step * f * (1.0F - f);
    }
    return 2.0F * sum * 45.0F * std::numbers::pi_v<float> * std::numbers::pi_v<float> / 128.0F;
}

// 1 m · 2 tan(size / 2), within 1 %: the picture's columns are 3 mm wide and its bytes have steps. A hard light is
// filtered by 1.2 texels of 4.6 mm to each side.
TEST(RenderLamps, APenumbraIsAsWideAsTheLightIsLarge) {
    for (const float size : {0.05F, 0.1F, 0.2F, 0.4F, 0.7F}) {
        const float width = 2.0F * std::tan(0.5F * size);
        EXPECT_NEAR(penumbraOf(size), width, 0.01F * width) << size;
    }
    EXPECT_LT(penumbraOf(0.0F), 0.0115F);
}

}  // namespace
}  // namespace taut::render::test
