// The thickness of cloth at its free edges. Numbers of pixels follow from the perspective.
#include <gtest/gtest.h>

#include "render_support.h"
#include "taut/render/private/depth_layer.h"
#include "taut/render/private/mask_layer.h"

namespace taut::render::test {
namespace {

// A level square of 1 m, of which the camera sees nothing but the edge, 2 m away.
view::FrameView edgeView(float hem) {
    view::FrameView view;
    view.camera.eye = {0.0F, 0.0F, 2.5F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    view.surfaces = {surface(view::quadMesh({0.0F, 1.0F, 0.0F}, 0.5F), glm::vec3(0.0F), glm::vec3(0.5F))};
    view.surfaces[0].name = "sheet";
    view.surfaces[0].twoSided = true;
    view.surfaces[0].hem = hem;
    return view;
}

// A metre that is 2 m away has 180 / (2 m · 2 tan 0.35) = 123.3 pixels: of 0.1 m, 12.3. The rim is round, its nearest
// place half a thickness in front of the edge.
TEST(RenderHem, AnEdgeSeenCloseIsAsThickAsTheCloth) {
    RendererOptions options = smallOptions();
    options.layers = {maskLayer({{"sheet", 0xffffffU}}), depthLayer(1e-3)};
    const image::Image picture = pictureOf(edgeView(0.1F), options);
    int rows = 0;
    for (std::size_t y = 0; y < 180; ++y) rows += picture.layer("mask")->rgb[3 * (y * 320 + 160)] != 0 ? 1 : 0;
    EXPECT_NEAR(rows, 12.3, 1.0);
    EXPECT_NEAR(picture.layer("depth")->numbers[90 * 320 + 160], 1950.0, 1.0);
    EXPECT_EQ(picture.layer("depth")->numbers[80 * 320 + 160], image::farDepth);
}

// 8 mm are 0.99 pixels.
TEST(RenderHem, BelowAPixelNoByteChanges) {
    view::FrameView view = edgeView(0.008F);
    view.camera.eye.y = 0.4F;
    const image::Image thin = pictureOf(view);
    view.surfaces[0].hem = 0.0F;
    EXPECT_EQ(thin.rgb, pictureOf(view).rgb);
}

// Two squares, seen from above, that meet along the z axis: there they are sewn, and look as if they were one.
TEST(RenderHem, IsNotWhereTwoEdgesAreOne) {
    view::FrameView view = edgeView(0.1F);
    view.camera.eye = {0.0F, 2.0F, 0.2F};
    view.surfaces.push_back(view.surfaces[0]);
    view.surfaces[0].transform[3].x = -0.5F;
    view.surfaces[1].transform[3].x = 0.5F;
    const image::Image hemmed = pictureOf(view);
    for (view::Surface& surface : view.surfaces) surface.hem = 0.0F;
    const image::Image plain = pictureOf(view);
    EXPECT_NE(hemmed.rgb, plain.rgb);
    for (float x = -0.05F; x < 0.06F; x += 0.01F)
        EXPECT_EQ(pixelOf(hemmed, view.camera, {x, 0.0F, 0.0F}), pixelOf(plain, view.camera, {x, 0.0F, 0.0F})) << x;
}

// Bytes of the ground beside the cloth are the same without a rim.
TEST(RenderHem, ShadowsAreThrownWithoutIt) {
    view::FrameView view = floorView();
    view.surfaces = {edgeView(0.1F).surfaces[0]};
    view.surfaces[0].transform[3].y = 0.5F;
    view.light.direction = {0.8F, -0.6F, 0.0F};
    const image::Image hemmed = pictureOf(view);
    view.surfaces[0].hem = 0.0F;
    const image::Image plain = pictureOf(view);
    EXPECT_NE(hemmed.rgb, plain.rgb);
    for (float x = 0.85F; x < 1.3F; x += 0.01F)  // the shadow lies from 0.17 to 1.17
        for (float z = -0.6F; z < 0.6F; z += 0.01F)
            ASSERT_EQ(pixelOf(hemmed, view.camera, {x, 0.0F, z}), pixelOf(plain, view.camera, {x, 0.0F, z}));
}

}  // namespace
}  // namespace taut::render::test
