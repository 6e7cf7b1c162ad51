// Places that must be lit, and places that must be in shadow, at any size of the shadow map.
#include <gtest/gtest.h>

#include <numbers>

#include "render_support.h"

namespace taut::render::test {
namespace {

constexpr float halfTurn = std::numbers::pi_v<float>;

RendererOptions optionsWith(int shadowSize) {
    RendererOptions options = smallOptions();
    options.shadowSize = shadowSize;
    return options;
}

// A square of 2 m in waves along x, of few triangles; its normals are those of a smooth surface.
view::Surface wavySheet(float height, float waves) {
    constexpr int cells = 24;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const float x = 2.0F * static_cast<float>(column) / cells - 1.0F;
            positions.emplace_back(x, 0.5F + height * std::sin(halfTurn * waves * x),
                                   2.0F * static_cast<float>(row) / cells - 1.0F);
        }
    }
    for (std::uint32_t row = 0; row < cells; ++row) {
        for (std::uint32_t column = 0; column < cells; ++column) {
            const std::uint32_t a = row * (cells + 1) + column, b = a + cells + 1;
            triangles.insert(triangles.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    }
    view::Surface sheet = surface(view::creasedMesh(positions, triangles, halfTurn), glm::vec3(0.0F), glm::vec3(0.6F));
    sheet.twoSided = true;
    return sheet;
}

// Waves that are less steep than the light throw no shadow: each pixel is the same as without shadows. The light falls
// from 17 degrees above the horizon, the slopes are at most 0.8 of its; triangles beside each other differ by 7
// degrees.
TEST(RenderShadow, WavesLessSteepThanTheLightAreLitAllOver) {
    view::FrameView view = floorView();
    view.light.direction = {1.0F, -0.3F, 0.15F};
    constexpr float waves = 2.0F;
    view.surfaces = {wavySheet(0.8F * 0.3F / (halfTurn * waves), waves)};
    RendererOptions options = optionsWith(512);
    options.shadows = false;
    const image::Image open = pictureOf(view, options);
    for (const int shadowSize : {512, 2048, 8192}) {
        const image::Image picture = pictureOf(view, optionsWith(shadowSize));
        int darker = 0;
        for (float x = -0.95F; x <= 0.95F; x += 0.02F) {
            for (float z = -0.95F; z <= 0.95F; z += 0.02F) {
                const glm::vec3 place(x, 0.5F, z);
                const int lost =
                    brightness(pixelOf(open, view.camera, place)) - brightness(pixelOf(picture, view.camera, place));
                darker += lost > 12 ? 1 : 0;  // four of 255 a channel
            }
        }
        EXPECT_EQ(darker, 0) << shadowSize;
    }
}

// Sky light alone is left beside the foot of a wall, but for the filter: 1.2 texels, which reach around the foot, and
// one between texels. Light that is let in to keep surfaces from shading themselves would be a strip behind the wall.
TEST(RenderShadow, NoLightGetsUnderTheFootOfAThinWall) {
    constexpr float half = 0.004F;
    view::FrameView view = floorView();
    view.camera.eye = {0.0F, 0.4F, 0.5F};
    view.light.direction = {0.2F, -0.4F, 1.0F};
    const float sine = -glm::normalize(view.light.direction).y;
    view.surfaces = {surface(view::boxMesh({0.6F, 0.5F, half}, 0.0F), {0.0F, 0.5F, 0.0F}, glm::vec3(0.5F))};
    const glm::vec3 sky = view.ground->colour * view.light.sky;
    for (const int shadowSize : {512, 2048, 8192}) {
        const image::Image picture = pictureOf(view, optionsWith(shadowSize));
        const float texel = 2.0F / static_cast<float>(shadowSize);  // [m] or less
        for (float z = half + std::max(2.2F * texel, 0.003F) / sine; z < 0.1F; z += 0.002F) {
            for (float x = -0.2F; x <= 0.2F; x += 0.02F) {
                const Pixel seen = pixelOf(picture, view.camera, {x, 0.0F, z});
                for (int channel = 0; channel < 3; ++channel)
                    EXPECT_LE(seen[channel], srgb(filmic(sky[channel])) + 1.5F) << shadowSize << ": " << x << ' ' << z;
            }
        }
    }
}

}  // namespace
}  // namespace taut::render::test
