// What pictures have besides colours: alpha, depth, a mask. Expected numbers follow from the geometry, or from pictures
// that have none of it.
#include <gtest/gtest.h>

#include <set>

#include "render_support.h"
#include "taut/render/private/depth_layer.h"
#include "taut/render/private/mask_layer.h"

namespace taut::render::test {
namespace {

int depthAt(const image::Image& picture, int x, int y) {
    return picture.layer("depth")->grey[static_cast<std::size_t>(y * picture.width + x)];
}

// A box of a metre in front of the camera, nothing else.
view::FrameView boxView() {
    view::FrameView view;
    view.camera.eye = {0.0F, 0.0F, 5.0F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    view.surfaces.push_back(surface(view::boxMesh(glm::vec3(0.5F), 0.0F), glm::vec3(0.0F), glm::vec3(0.5F)));
    view.surfaces.back().name = "box";
    return view;
}

TEST(RenderLayers, DepthIsTheDistanceAlongTheAxisToWithinAStep) {
    RendererOptions options = smallOptions();
    options.layers = {depthLayer(1e-3)};
    for (const int samples : {1, 4}) {
        options.samples = samples;
        view::FrameView view = boxView();
        view.camera.eye.z = 7.2506F;
        const image::Image picture = pictureOf(view, options);
        // The box's face is at z = 0.5, all of it as far along the axis. It covers 1 m of 6.7506 m · 2 tan(0.35): 36
        // pixels of 180.
        for (const int x : {144, 160, 175})
            for (const int y : {74, 90, 106}) EXPECT_NEAR(depthAt(picture, x, y), 6750.6, 0.51) << x << " " << y;
        EXPECT_EQ(depthAt(picture, 20, 20), image::farDepth);
    }
}

TEST(RenderLayers, DepthOfTheGroundIsThatOfThePlane) {
    RendererOptions options = smallOptions();
    options.layers = {depthLayer(1e-3)};
    const view::FrameView view = floorView();
    const image::Image picture = pictureOf(view, options);
    // Eye (0, 3, 5), axis to the origin: sine and cosine of its slope are 3/√34, 5/√34. A ray through the middle of row
    // y rises by t against it, and meets the plane where 3 = ahead (3 - 5 t) / √34.
    const double pixel = 2.0 * std::tan(0.35) / 180.0;
    for (const int y : {60, 90, 150}) {
        const double t = pixel * (89.5 - y);
        const double ahead = 3.0 * std::sqrt(34.0) / (3.0 - 5.0 * t);
        for (const int x : {100, 160, 200}) EXPECT_NEAR(depthAt(picture, x, y), 1000.0 * ahead, 0.51) << x << " " << y;
    }
}

TEST(RenderLayers, DepthBeyondItsRangeIsItsEnd) {
    RendererOptions options = smallOptions();
    options.layers = {depthLayer(1e-5)};  // 0.65534 m
    const image::Image picture = pictureOf(boxView(), options);
    EXPECT_EQ(depthAt(picture, 160, 90), image::farDepth - 1);
    EXPECT_EQ(depthAt(picture, 0, 0), image::farDepth);
}

TEST(RenderLayers, TheMaskHasTheColoursOfWhatIsSeenAndNoOthers) {
    view::FrameView view = floorView();
    const auto add = [&](const char* name, float size, glm::vec3 at) {
        view.surfaces.push_back(surface(view::sphereMesh(size), at, glm::vec3(0.5F)));
        view.surfaces.back().name = name;
    };
    add("large", 0.6F, {0.0F, 0.6F, 0.0F});
    add("beside", 0.3F, {1.2F, 0.3F, 0.0F});
    add("hidden", 0.1F, {0.0F, 0.4F, -1.0F});
    add("buried", 0.3F, {-1.2F, -0.5F, 0.0F});
    add("nameless", 0.2F, {-0.5F, 0.2F, 1.0F});
    RendererOptions options = smallOptions();
    options.layers = {
        maskLayer({{"large", 0x800000U}, {"beside", 0x0080c0U}, {"hidden", 0x00ff00U}, {"buried", 0x0000ffU}})};
    const image::Image picture = pictureOf(view, options);
    std::set<std::uint32_t> seen;
    const std::vector<std::uint8_t>& mask = picture.layer("mask")->rgb;
    for (std::size_t i = 0; i < mask.size(); i += 3)
        seen.insert(static_cast<std::uint32_t>(mask[i]) << 16 | static_cast<std::uint32_t>(mask[i + 1]) << 8 |
                    mask[i + 2]);
    EXPECT_EQ(seen, (std::set<std::uint32_t>{0, 0x800000U, 0x0080c0U}));
}

// One byte laid over another, as programs do.
double over(int colour, int alpha, int below) {
    return colour * alpha / 255.0 + below * (1.0 - alpha / 255.0);
}

TEST(RenderLayers, WhereAlphaIsOneTheColoursAreThoseOfThePictureWithoutAndBetweenNothingBrightens) {
    // Sky alone behind: what is neither opaque nor clear is an edge, and lies between thing and background.
    RendererOptions options = smallOptions();
    view::FrameView view = boxView();
    view.surfaces[0].transform = glm::rotate(glm::mat4(1.0F), 0.5F, {0.3F, 1.0F, 0.2F});
    options.alpha = true;
    const image::Image clear = pictureOf(view, options);
    options.alpha = false;
    for (const float back : {0.05F, 0.8F}) {
        view.background.top = view.background.horizon = glm::vec3(back);
        const image::Image opaque = pictureOf(view, options);
        int edges = 0;
        for (std::size_t i = 0; i < clear.alpha.size(); ++i) {
            const int alpha = clear.alpha[i];
            edges += alpha > 0 && alpha < 255 ? 1 : 0;
            for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
                if (alpha == 255) EXPECT_EQ(clear.rgb[c], opaque.rgb[c]);
                // The background is dithered by half a step.
                if (alpha == 0) EXPECT_NEAR(opaque.rgb[c], srgb(back), 1.01);
            }
        }
        EXPECT_GT(edges, 100);
        EXPECT_LT(edges, 800);
    }
}

TEST(RenderLayers, ShadowsOverTheGroundsOwnColourAreThoseOfTheGround) {
    view::FrameView view = floorView();
    view.light.direction = {0.5F, -1.0F, -0.3F};
    view.surfaces.push_back(surface(view::sphereMesh(0.5F), {0.0F, 0.7F, 0.0F}, {0.6F, 0.2F, 0.1F}));
    view.surfaces.back().name = "ball";
    RendererOptions options = smallOptions();
    options.layers = {maskLayer({{"ball", 0xffffffU}})};
    options.alpha = true;
    const image::Image clear = pictureOf(view, options);
    options.alpha = false;
    // Over its own colour to rounding; over a deep blue, three channels of which one alpha serves, to a tenth.
    for (const auto& [colour, tolerance] :
         {std::pair(view.ground->colour, 2.0), {glm::vec3(0.1F, 0.25F, 0.5F), 25.5}}) {
        view.ground->colour = colour;
        const image::Image opaque = pictureOf(view, options);
        view::FrameView empty = view;
        empty.surfaces.clear();
        const image::Image ground = pictureOf(empty, options);
        double worst = 0.0;
        int shaded = 0;
        for (int y = 60; y < 179; ++y) {  // below the horizon's fading
            for (int x = 1; x < 319; ++x) {
                bool isGround = true;
                for (const int i : {-321, -320, -319, -1, 0, 1, 319, 320, 321})
                    isGround = isGround && clear.layer("mask")->rgb[3 * static_cast<std::size_t>(y * 320 + x + i)] == 0;
                if (!isGround) continue;
                const auto at = static_cast<std::size_t>(y * 320 + x);
                shaded += clear.alpha[at] > 64 ? 1 : 0;
                for (std::size_t c = 3 * at; c < 3 * at + 3; ++c)
                    worst =
                        std::max(worst, std::abs(over(clear.rgb[c], clear.alpha[at], ground.rgb[c]) - opaque.rgb[c]));
            }
        }
        EXPECT_GT(shaded, 500);
        EXPECT_LE(worst, tolerance);
    }
}

}  // namespace
}  // namespace taut::render::test
