// Where the shadow map lies and which part of the ground needs it: geometry without GL.
#include <gtest/gtest.h>

#include "render_support.h"
#include "taut/render/private/ground.h"
#include "taut/render/private/light_box.h"

namespace taut::render::test {
namespace {

Bounds boundsOf(glm::vec3 low, glm::vec3 high) {
    Bounds bounds;
    bounds.include(low);
    bounds.include(high);
    return bounds;
}

view::FrameView slantedView() {
    view::FrameView view = floorView();
    view.light.direction = {0.6F, -1.0F, -0.4F};
    return view;
}

TEST(RenderLightBox, HoldsAllCastersInView) {
    const std::vector<Bounds> casters{boundsOf({-1.0F, 0.0F, -1.0F}, {1.0F, 2.0F, 0.5F}),
                                      boundsOf({1.5F, 0.2F, 0.0F}, {2.0F, 0.7F, 0.5F})};
    const LightBox box = lightBox(slantedView(), slantedView().light.direction, casters, 16.0F / 9.0F, 2048);
    for (const Bounds& caster : casters) {
        for (const glm::vec3& corner : caster.corners()) {
            const glm::vec3 at = box.toMap * glm::vec4(corner, 1.0F);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GT(at[axis], 0.0F);
                EXPECT_LT(at[axis], 1.0F);
            }
        }
    }
}

TEST(RenderLightBox, DepthGrowsAlongTheLight) {
    const view::FrameView view = slantedView();
    const std::vector<Bounds> casters{boundsOf(glm::vec3(-1.0F), glm::vec3(1.0F))};
    const LightBox box = lightBox(view, view.light.direction, casters, 1.5F, 2048);
    const glm::vec3 way = glm::normalize(view.light.direction);
    const glm::vec3 step = glm::vec3(box.toMap * glm::vec4(way, 0.0F));
    EXPECT_NEAR(step.x, 0.0F, 1e-6F);  // rounding of unit vectors
    EXPECT_NEAR(step.y, 0.0F, 1e-6F);
    EXPECT_NEAR(step.z * box.size.z, 1.0F, 1e-5F);
}

TEST(RenderLightBox, TexelsStayInPlaceWhileACasterMoves) {
    const view::FrameView view = slantedView();
    const int texels = 2048;
    const LightBox before = lightBox(view, view.light.direction,
                                     std::vector{boundsOf({-1.0F, 0.0F, -1.0F}, {1.0F, 1.5F, 1.0F})}, 1.5F, texels);
    for (int i = 1; i < 20; ++i) {
        const glm::vec3 moved(0.0013F * static_cast<float>(i), 0.0F, -0.0007F * static_cast<float>(i));
        const LightBox after =
            lightBox(view, view.light.direction,
                     std::vector{boundsOf(glm::vec3(-1.0F, 0.0F, -1.0F) + moved, glm::vec3(1.0F, 1.5F, 1.0F) + moved)},
                     1.5F, texels);
        ASSERT_EQ(before.size.x, after.size.x);
        ASSERT_EQ(before.size.y, after.size.y);
        const glm::vec2 shift = glm::vec2(after.toMap[3] - before.toMap[3]) * static_cast<float>(texels);
        // Map coordinates of the order of 1 have an error of 1e-7, which is 2e-4 texels.
        EXPECT_NEAR(shift.x, std::round(shift.x), 1e-3F);
        EXPECT_NEAR(shift.y, std::round(shift.y), 1e-3F);
    }
}

TEST(RenderLightBox, FarCastersDoNotCoarsenWhatIsSeen) {
    const view::FrameView view = slantedView();
    const Bounds near = boundsOf({-1.0F, 0.0F, -1.0F}, {1.0F, 1.5F, 1.0F});
    const Bounds endless = boundsOf({-5000.0F, -0.1F, -5000.0F}, {5000.0F, 0.0F, 5000.0F});
    const LightBox box = lightBox(view, view.light.direction, std::vector{near, endless}, 1.5F, 2048);
    EXPECT_LT(box.size.x, 200.0F);  // the camera sees some 36 m far
    EXPECT_LT(box.size.y, 200.0F);
}

TEST(RenderLightBox, WorksWithoutCasters) {
    const LightBox box = lightBox(slantedView(), slantedView().light.direction, {}, 1.5F, 2048);
    EXPECT_GT(box.size.x, 0.0F);
    EXPECT_TRUE(std::isfinite(box.toMap[3][0]));
}

TEST(RenderGround, CellsInShadowAreShaded) {
    const view::FrameView view = slantedView();
    const std::vector<Bounds> casters{boundsOf({-0.2F, 1.0F, -0.2F}, {0.2F, 1.2F, 0.2F})};
    const std::array light{Shadower{lightBox(view, view.light.direction, casters, 1.5F, 2048), 0.03F}};
    const GroundMesh mesh = groundMesh(glm::vec3(0.0F), 0.0F, 30.0F, light, casters, std::nullopt);
    const auto covers = [&](const std::vector<std::uint32_t>& triangles, glm::vec2 place) {
        for (std::size_t i = 0; i < triangles.size(); i += 6) {  // two triangles a cell: corners a, c opposite
            const glm::vec3 a = mesh.positions[triangles[i]];
            const glm::vec3 c = mesh.positions[triangles[i + 2]];
            if (place.x >= a.x && place.x <= c.x && place.y >= a.z && place.y <= c.z) return true;
        }
        return false;
    };
    // The box's middle, 1.1 m high, throws its shadow to (0.66, -0.44).
    EXPECT_TRUE(covers(mesh.shaded, {0.66F, -0.44F}));
    EXPECT_TRUE(covers(mesh.open, {-3.0F, 3.0F}));
    EXPECT_FALSE(covers(mesh.shaded, {-3.0F, 3.0F}));
}

TEST(RenderGround, OnlyCellsNearTheShadowOfWhatMovesChange) {
    const view::FrameView view = slantedView();
    const std::vector<Bounds> casters{boundsOf({-0.2F, 1.0F, -0.2F}, {0.2F, 1.2F, 0.2F}),
                                      boundsOf({-3.2F, 1.0F, -0.2F}, {-2.8F, 1.2F, 0.2F})};
    const std::array light{Shadower{lightBox(view, view.light.direction, casters, 1.5F, 2048), 0.03F}};
    const GroundMesh mesh =
        groundMesh(glm::vec3(0.0F), 0.0F, 30.0F, light, casters, std::nullopt, std::span(casters).subspan(1));
    // Shadows fall 0.66 m to the right and 0.44 m back: of the still box to x = 0.66, of the other to x = -2.34.
    const auto changesAt = [&](glm::vec2 place) {
        for (std::size_t i = 0; i < mesh.shaded.size(); i += 6) {
            const glm::vec3 a = mesh.positions[mesh.shaded[i]], c = mesh.positions[mesh.shaded[i + 2]];
            if (place.x >= a.x && place.x <= c.x && place.y >= a.z && place.y <= c.z)
                return mesh.changes[mesh.shaded[i]] != 0;
        }
        ADD_FAILURE() << "not shaded";
        return false;
    };
    EXPECT_FALSE(changesAt({0.66F, -0.44F}));
    EXPECT_TRUE(changesAt({-2.34F, -0.44F}));
}

TEST(RenderGround, CellsCoverTheDiscOnce) {
    const view::FrameView view = slantedView();
    const std::vector<Bounds> casters{boundsOf({-0.2F, 1.0F, -0.2F}, {0.2F, 1.2F, 0.2F})};
    const std::array light{Shadower{lightBox(view, view.light.direction, casters, 1.5F, 2048), 0.03F}};
    const GroundMesh mesh = groundMesh({1.0F, 5.0F, 2.0F}, 0.25F, 10.0F, light, casters, std::nullopt);
    double area = 0.0;
    for (const auto* triangles : {&mesh.shaded, &mesh.open}) {
        for (std::size_t i = 0; i < triangles->size(); i += 3) {
            const glm::vec3 a = mesh.positions[(*triangles)[i]];
            const glm::vec3 b = mesh.positions[(*triangles)[i + 1]];
            const glm::vec3 c = mesh.positions[(*triangles)[i + 2]];
            const glm::vec3 normal = glm::cross(b - a, c - a);
            EXPECT_GT(normal.y, 0.0F);  // seen from above
            EXPECT_EQ(a.y, 0.25F);
            area += 0.5 * static_cast<double>(normal.y);
        }
    }
    // At least the disc, at most its square.
    EXPECT_GT(area, 3.14 * 100.0);
    EXPECT_LE(area, 400.001);
}

}  // namespace
}  // namespace taut::render::test
