// Plain ground and sky are drawn without GL, by formulas of their own: they are to be those of GL.
#include <gtest/gtest.h>

#include <cmath>

#include "render_support.h"

namespace taut::render::test {
namespace {

// Of 255.
struct Difference {
    double mean = 0.0;  // of sizes
    double far = 0.0;   // part of the pixels that are off by more than 3
};

Difference differenceOf(const view::FrameView& view) {
    RendererOptions options = smallOptions();
    const image::Image own = pictureOf(view, options);
    options.plainByGl = true;
    const image::Image gl = pictureOf(view, options);
    Difference difference;
    const double share = 1.0 / static_cast<double>(own.rgb.size());
    for (std::size_t i = 0; i < own.rgb.size(); ++i) {
        const int off = own.rgb[i] - gl.rgb[i];
        difference.mean += share * std::abs(off);
        difference.far += std::abs(off) > 3 ? share : 0.0;
    }
    return difference;
}

// A ball, a cloth above it, and a box that is half in the ground.
view::FrameView plainView() {
    view::FrameView view = floorView();
    view.light.direction = {0.5F, -1.0F, -0.3F};
    static const view::Mesh ball = view::sphereMesh(0.4F), box = view::boxMesh(glm::vec3(0.3F), 0.02F);
    static const view::Mesh sheet = view::quadMesh({0.3F, 1.0F, 0.2F}, 0.6F);
    view.surfaces.push_back(surface(ball, {0.9F, 0.4F, 0.0F}, {0.6F, 0.2F, 0.1F}));
    view.surfaces.push_back(surface(box, {-0.9F, 0.1F, 0.4F}, {0.1F, 0.5F, 0.2F}));
    view.surfaces.push_back(surface(sheet, {0.6F, 1.0F, 0.0F}, {0.1F, 0.3F, 0.6F}));
    view.surfaces.back().twoSided = true;
    return view;
}

// Rounding changes few bytes, by one. Larger differences are at borders between surfaces, and where lines are finer than
// pixels: GL finds the size of a pixel on the ground from its neighbours.
void expectAlike(const view::FrameView& view, double far = 0.0002) {
    const Difference difference = differenceOf(view);
    EXPECT_LT(difference.mean, 0.02);
    EXPECT_LE(difference.far, far);
}

TEST(RenderGround, IsThatOfGl) {
    expectAlike(plainView());
}

TEST(RenderGround, HasTheLinesOfGl) {
    view::FrameView view = plainView();
    view.ground->gridSpacing = 0.5F;
    expectAlike(view, 0.002);
}

TEST(RenderGround, IsThatOfGlUnderWideLightsAndLamps) {
    view::FrameView view = plainView();
    view.light.softness = 0.3F;
    view.lamps.resize(2);
    view.lamps[0].direction = {0.5F, -1.0F, 0.6F};
    view.lamps[1].direction = {-0.5F, 1.0F, 0.6F};
    expectAlike(view);
}

// The horizon crosses the picture; the ground is seen from below as well.
TEST(RenderGround, ItsSkyIsThatOfGl) {
    view::FrameView view = plainView();
    view.camera.eye = {0.0F, 0.7F, 5.0F};
    view.camera.target = {0.0F, 0.9F, 0.0F};
    expectAlike(view);
    view.camera.eye.y = -0.4F;
    expectAlike(view);
    view.ground.reset();
    expectAlike(view);
}

}  // namespace
}  // namespace taut::render::test
