// Many samples a pixel, moments of an exposure, and tubes thinner than a pixel. Expected numbers are lengths and areas;
// without a ground, alpha says how much of a pixel is covered.
#include <gtest/gtest.h>

#include <numbers>

#include "render_support.h"
#include "taut/render/private/mask_layer.h"
#include "taut/view/private/tube.h"

namespace taut::render::test {
namespace {

RendererOptions coverageOptions(int samples) {
    RendererOptions options = smallOptions();
    options.alpha = true;
    options.samples = samples;
    return options;
}

double rowSum(const image::Image& picture, int y) {
    double sum = 0.0;
    for (int x = 0; x < picture.width; ++x) sum += picture.alpha[y * picture.width + x] / 255.0;
    return sum;
}

double columnSum(const image::Image& picture, int x) {
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y) sum += picture.alpha[y * picture.width + x] / 255.0;
    return sum;
}

// Looks along -z from 5 m; a pixel is `pixel` metres at z = 0.
view::FrameView emptyView() {
    view::FrameView view;
    view.camera.eye = {0.0F, 0.0F, 5.0F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    return view;
}
const double pixel = 10.0 * std::tan(0.35) / 180.0;

TEST(RenderSamples, AnEdgeStandsWhereItIsToTheShareOfASample) {
    // A sheet whose left side leans by a fiftieth; its right side is outside the picture. Samples that each have a
    // column of their own find an edge that runs along a column to half their distance, 1 / (2 n) of a pixel; it
    // crosses a fiftieth within a row.
    view::FrameView view = emptyView();
    view.surfaces.push_back(surface(view::quadMesh({0.0F, 0.0F, 1.0F}, 10.0F), {10.013F, 0.0F, 0.0F}, glm::vec3(0.5F)));
    const float angle = std::atan(0.02F);
    view.surfaces[0].transform = glm::rotate(glm::mat4(1.0F), angle, {0.0F, 0.0F, 1.0F}) * view.surfaces[0].transform;
    double before = 1.0;
    for (const auto& [samples, least, most] : {std::tuple(4, 0.1, 0.14), {8, 0.04, 0.08}, {16, 0.0, 0.045}}) {
        const image::Image picture = pictureOf(view, coverageOptions(samples));
        double worst = 0.0;
        for (int y = 10; y < 170; ++y) {
            const double height = (90.0 - (y + 0.5)) * pixel;  // [m]
            const double edge = 0.013 / std::cos(static_cast<double>(angle)) - 0.02 * height;
            worst = std::max(worst, std::abs(rowSum(picture, y) - (160.0 - edge / pixel)));
        }
        EXPECT_GE(worst, least) << samples;
        EXPECT_LE(worst, most) << samples;
        EXPECT_LT(worst, before);
        before = worst;
    }
}

TEST(RenderSamples, APictureOfMomentsIsTheirMeanInLight) {
    // A white wall moves by ten pixels a moment: n of four moments cover a column.
    view::FrameView view = emptyView();
    view.surfaces.push_back(surface(view::quadMesh({0.0F, 0.0F, 1.0F}, 10.0F), {10.0F, 0.0F, 0.0F}, glm::vec3(0.5F)));
    const view::FrameView still = view;
    for (int i = 0; i < 4; ++i) {
        view.moments.push_back(still);
        view.moments.back().surfaces[0].transform[3].x += static_cast<float>(10 * i * pixel);
    }
    const image::Image clear = pictureOf(view, coverageOptions(4));
    for (int n = 0; n <= 4; ++n) EXPECT_NEAR(clear.alpha[90 * 320 + 155 + 10 * n], 63.75 * n, 0.51);
    // Over the sky, which nothing shades, the mean of two colours in light.
    const image::Image opaque = pictureOf(view), none = pictureOf(emptyView());
    const image::Image all = pictureOf(still);
    const auto light = [](int byte) { return std::pow((byte / 255.0 + 0.055) / 1.055, 2.4); };
    for (int c = 0; c < 3; ++c) {
        const auto at = [&](const image::Image& picture, int x) { return light(picture.rgb[3 * (90 * 320 + x) + c]); };
        const double half = 0.5 * (at(none, 175) + at(all, 175));
        EXPECT_NEAR(at(opaque, 175), half, 0.01);
        EXPECT_GT(std::abs(at(all, 175) - at(none, 175)), 0.04);
    }
}

// An edge that is not where the lens is focused on lies anywhere in a disc of radius c = R |1 - F/D| (focal length in
// pixels) / F. A place t c from it sees of that disc the part beyond a chord.
TEST(RenderSamples, PointsOutOfFocusAreSpreadOverADisc) {
    view::FrameView view = emptyView();
    view.surfaces.push_back(surface(view::quadMesh({0.0F, 0.0F, 1.0F}, 10.0F), {10.0F, 0.0F, 0.0F}, glm::vec3(0.5F)));
    view.camera.lensRadius = 0.2F;
    const double focal = 90.0 / std::tan(0.35), behind = 5.0;
    for (const double focus : {5.0, 4.0, 7.0}) {
        view.camera.focus = static_cast<float>(focus);
        const image::Image picture = pictureOf(view, coverageOptions(4));
        const double c = 0.2 * std::abs(1.0 - focus / behind) * focal / focus;  // [pixels]
        for (int x = 140; x < 180; ++x) {
            const double t = c > 0.0 ? std::clamp((x + 0.5 - 160.0) / c, -1.0, 1.0) : (x < 160 ? -1.0 : 1.0);
            const double seen = 0.5 + (std::asin(t) + t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
            // 32 places that are spread evenly are off by less than 3 in 64.
            EXPECT_NEAR(picture.alpha[90 * 320 + x] / 255.0, seen, c > 0.0 ? 0.05 : 0.01)
                << focus << " m, column " << x;
        }
    }
}

TEST(RenderSamples, ATubeCoversAsMuchOfThePictureAsItIsWideAtAnyDistance) {
    // Seen across a corner, ten sides are as wide as the cosine of a twentieth of a turn.
    constexpr float radius = 0.01F;
    const double width = 2.0 * radius * std::cos(std::numbers::pi / 10.0);
    const double focal = 90.0 / std::tan(0.35);
    for (const double radiusInPixels : {1.6, 0.7, 0.45, 0.2, 0.05}) {
        const double ahead = radius * focal / radiusInPixels;
        view::FrameView view = emptyView();
        view.camera.eye.z = static_cast<float>(ahead);
        view.background.fadesWithCamera = false;
        const auto reach = static_cast<float>(2.0 * ahead);
        // Aslant, so that it meets pixels everywhere.
        const std::array<glm::vec3, 2> line{glm::vec3(-reach, -0.23F * reach, 0.0F), {reach, 0.23F * reach, 0.0F}};
        view::Mesh mesh{std::make_shared<view::Topology>(view::tubeTopology(2, 1, 10, 2.0F * reach, radius)),
                        std::make_shared<view::Geometry>(view::tubeGeometry(line, 1, 10, radius))};
        view.surfaces.push_back(surface(mesh, glm::vec3(0.0F), glm::vec3(0.8F)));
        view.surfaces.back().tubeRadius = radius;
        const image::Image picture = pictureOf(view, coverageOptions(4));
        const double expected = width * focal / ahead * std::hypot(1.0, 0.23);  // of a column
        double sum = 0.0, least = 1e9;
        for (int x = 20; x < 300; ++x) {
            const double column = columnSum(picture, x);
            sum += column;
            least = std::min(least, column);
        }
        // Four samples a pixel, over 280 columns, and bytes of alpha.
        EXPECT_NEAR(sum / 280.0, expected, 0.015 * expected) << radiusInPixels;
        EXPECT_GT(least, 0.7 * expected) << radiusInPixels;  // no gaps
    }
}

TEST(RenderSamples, AThinTubeIsHiddenByWhatIsBeforeItAndHasTheSameColourAsAThickOne) {
    view::FrameView view = emptyView();
    view.camera.eye.z = 20.0F;
    const std::array<glm::vec3, 2> line{glm::vec3(-20.0F, 0.0F, 0.0F), {20.0F, 0.0F, 0.0F}};
    const auto tube = [&](float radius) {
        view::Mesh mesh{std::make_shared<view::Topology>(view::tubeTopology(2, 1, 10, 40.0F, radius)),
                        std::make_shared<view::Geometry>(view::tubeGeometry(line, 1, 10, radius))};
        view::Surface result = surface(mesh, glm::vec3(0.0F), {0.7F, 0.3F, 0.1F});
        result.tubeRadius = radius;
        return result;
    };
    RendererOptions options = coverageOptions(4);
    options.layers = {maskLayer({{"wall", 0xff0000U}})};
    view.surfaces.push_back(tube(0.02F));
    view.surfaces.push_back(surface(view::quadMesh({0.0F, 0.0F, 1.0F}, 4.0F), {0.0F, 0.0F, 1.0F}, glm::vec3(0.5F)));
    view.surfaces.back().name = "wall";
    const image::Image thin = pictureOf(view, options);
    view::FrameView alone = view;
    alone.surfaces.erase(alone.surfaces.begin());
    const image::Image wall = pictureOf(alone, options);
    for (std::size_t i = 0; i < wall.alpha.size(); ++i)
        if (wall.alpha[i] == 255)
            for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
                EXPECT_NEAR(thin.rgb[c], wall.rgb[c], 2);  // their shadow maps differ

    // Five pixels wide, the mean in light of all that is seen of it in a column is its colour.
    view.surfaces[0] = tube(0.2F);
    const image::Image thick = pictureOf(view, options);
    const auto light = [](int byte) { return std::pow((byte / 255.0 + 0.055) / 1.055, 2.4); };
    const auto colourOf = [&](const image::Image& picture, std::size_t c) {
        double sum = 0.0, cover = 0.0;
        for (std::size_t at = 30; at < picture.alpha.size(); at += 320) {
            sum += picture.alpha[at] * light(picture.rgb[3 * at + c]);
            cover += picture.alpha[at];
        }
        return sum / cover;
    };
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(colourOf(thin, c) / colourOf(thick, c), 1.0, 0.2) << c;  // three rows stand for all
}

}  // namespace
}  // namespace taut::render::test
