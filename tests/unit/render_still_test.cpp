// Data kept from picture to picture changes nothing: the same bytes as with everything drawn anew.
#include <gtest/gtest.h>

#include <functional>

#include "render_support.h"

namespace taut::render::test {
namespace {

// A cloth that moves over a ball and a box that sinks through the ground, both of which stand still as it goes on.
view::FrameView stillFrame(int number) {
    view::FrameView view = floorView();
    // Nothing is kept of plain ground: checks.
    view::Finish checks;
    checks.pattern = view::Pattern::checker;
    checks.repeat = 0.5F;
    view.ground->pattern = std::make_shared<const view::Finish>(checks);
    view.light.direction = {0.5F, -1.0F, -0.3F};
    static const view::Mesh ball = view::sphereMesh(0.4F), box = view::boxMesh(glm::vec3(0.3F), 0.02F);
    static const view::Mesh sheet = view::quadMesh({0.3F, 1.0F, 0.2F}, 0.6F);
    view.surfaces.push_back(surface(ball, {0.9F, 0.4F, 0.0F}, {0.6F, 0.2F, 0.1F}));
    view.surfaces.push_back(surface(box, {-0.9F, 0.1F, 0.4F}, {0.1F, 0.5F, 0.2F}));
    const float way = 0.02F * static_cast<float>(number % 3);
    view.surfaces.push_back(surface(sheet, {0.6F - way, 1.0F - 0.5F * way, 0.0F}, {0.1F, 0.3F, 0.6F}));
    view.surfaces.back().twoSided = true;
    return view;
}

// Expects the same of a renderer that keeps and one that does not, for frames that `change` changes; some data is
// kept from the tenth on.
void expectSameBytes(const std::function<void(int, view::FrameView&)>& change) {
    RendererOptions options = smallOptions();
    Renderer keeping(options);
    options.keepsStill = false;
    Renderer plain(options);
    for (int i = 0; i < 15; ++i) {
        view::FrameView view = stillFrame(i);
        change(i, view);
        ASSERT_EQ(keeping.draw(view).rgb, plain.draw(view).rgb) << "frame " << i;
    }
}

TEST(RenderStill, UnderAStillCameraThePictureIsAsDrawnAnew) {
    expectSameBytes([](int, view::FrameView&) {});
}

TEST(RenderStill, ACameraThatMovesOnAndStopsIsFollowed) {
    expectSameBytes([](int i, view::FrameView& view) { view.camera.eye.x = i < 12 ? 0.0F : 0.4F; });
}

TEST(RenderStill, ANewLightFallsOnWhatIsStill) {
    expectSameBytes([](int i, view::FrameView& view) { view.light.direction.x = i < 12 ? 0.5F : -0.5F; });
    expectSameBytes([](int i, view::FrameView& view) { view.light.colour = glm::vec3(i < 12 ? 3.0F : 1.0F); });
}

TEST(RenderStill, LampsThatTurnAndAWideSunAreFollowed) {
    expectSameBytes([](int i, view::FrameView& view) {
        view.light.softness = 0.2F;
        view.lamps.resize(2);
        view.lamps[0].direction = {i < 12 ? 0.5F : 0.4F, -1.0F, 0.6F};
        view.lamps[1].shadow = i < 13;
    });
}

TEST(RenderStill, GroundThatSinksIsDrawnAnew) {
    expectSameBytes([](int i, view::FrameView& view) { view.ground->height = i < 12 ? 0.0F : -0.1F; });
}

TEST(RenderStill, StillPartsMayMoveOrGo) {
    expectSameBytes([](int i, view::FrameView& view) {
        if (i >= 12) view.surfaces[0].transform[3].x += 0.1F;
    });
    expectSameBytes([](int i, view::FrameView& view) {
        if (i >= 12) view.surfaces.erase(view.surfaces.begin());
    });
}

TEST(RenderStill, TheDebugViewComesAndGoes) {
    expectSameBytes([](int i, view::FrameView& view) {
        view.showMarks = i % 6 == 2;
        view.marks.lines.push_back({{-1.0F, 0.0F, 0.0F}, {1.0F, 0.5F, 0.0F}, {1.0F, 0.0F, 0.0F}});
    });
}

}  // namespace
}  // namespace taut::render::test
