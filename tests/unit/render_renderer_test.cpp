// How the renderer behaves as an object: repeatable, on either library, on any thread, clear about failures.
#include "taut/render/renderer.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "render_support.h"
#include "taut/core/error.h"
#include "taut/render/private/context.h"
#include "taut/render/private/egl_devices.h"
#include "taut/render/private/mesh_cache.h"

namespace taut::render::test {
namespace {

view::FrameView someView() {
    view::FrameView view = floorView();
    view.light.direction = {0.5F, -1.0F, -0.3F};
    view.surfaces.push_back(surface(view::sphereMesh(0.4F), {0.3F, 0.4F, 0.0F}, {0.6F, 0.2F, 0.1F}));
    view::Surface cloth = surface(view::quadMesh({0.3F, 1.0F, 0.2F}, 0.6F), {-0.6F, 0.8F, 0.0F}, {0.1F, 0.3F, 0.6F});
    view::Finish finish = *cloth.finish;
    finish.pattern = view::Pattern::tartan;
    finish.weave = 1.0F;
    finish.sheen = 0.5F;
    cloth.finish = std::make_shared<const view::Finish>(finish);
    cloth.twoSided = true;
    view.surfaces.push_back(cloth);
    return view;
}

std::string messageOf(const std::function<void()>& action, core::ErrorKind code) {
    try {
        action();
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), code) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return {};
}

TEST(RenderRenderer, DrawsTheSamePixelsWhateverItDrewBefore) {
    Renderer renderer(smallOptions());
    const view::FrameView view = someView();
    view::FrameView other = view;
    other.surfaces.pop_back();
    other.camera.eye.x = 2.0F;
    other.showMarks = true;
    other.marks.dots.push_back({{0.0F, 0.5F, 0.0F}, glm::vec3(1.0F), 5.0F});
    const image::Image first = renderer.draw(view);
    EXPECT_NE(renderer.draw(other).rgb, first.rgb);
    EXPECT_EQ(renderer.draw(view).rgb, first.rgb);
    EXPECT_EQ(pictureOf(view).rgb, first.rgb);
}

TEST(RenderRenderer, ChangedItDrawsAsOneMadeSo) {
    RendererOptions options = smallOptions();
    Renderer renderer(options);
    const view::FrameView view = someView();
    for (int i = 0; i < 3; ++i) (void)renderer.draw(view);  // resting things are kept
    const image::Image first = renderer.draw(view);
    options.width = 160;
    options.height = 90;
    options.samples = 1;
    options.shadowSize = 512;
    renderer.change(options);
    EXPECT_EQ(renderer.draw(view).rgb, pictureOf(view, options).rgb);
    options.occlusion = false;
    renderer.change(options);
    EXPECT_EQ(renderer.draw(view).rgb, pictureOf(view, options).rgb);
    renderer.change(smallOptions());
    EXPECT_EQ(renderer.draw(view).rgb, first.rgb);
}

TEST(RenderRenderer, BothLibrariesDrawTheSamePixels) {
    RendererOptions options = smallOptions();
    const image::Image first = pictureOf(someView(), options);
    options.backend = Backend::egl;
    EXPECT_EQ(pictureOf(someView(), options).rgb, first.rgb);
}

TEST(RenderRenderer, OsmesaThatTheBuildDidNotFindIsRefused) {
    if (backends().front() == Backend::osmesa) GTEST_SKIP() << "OSMesa is here";
    RendererOptions options = smallOptions();
    options.backend = Backend::osmesa;
    const std::string message = messageOf([&] { Renderer renderer(options); }, core::ErrorKind::noRenderer);
    EXPECT_NE(message.find("use --gl egl"), std::string::npos) << message;
}

TEST(RenderRenderer, TellsWhatDraws) {
    RendererOptions options = smallOptions();
    for (const Backend backend : backends()) {
        options.backend = backend;
        const RendererInfo info = Renderer(options).info();
        EXPECT_EQ(info.backend, backend == Backend::osmesa ? "osmesa" : "egl");
        EXPECT_FALSE(info.vendor.empty());
        EXPECT_FALSE(info.renderer.empty());
        EXPECT_FALSE(info.version.empty());
    }
}

TEST(RenderRenderer, EglTakesTheDeviceWithTheNumber) {
    RendererOptions options = smallOptions();
    options.backend = Backend::egl;
    const std::vector<EglDevice> devices = eglDevices();
    ASSERT_FALSE(devices.empty());
    for (const EglDevice& device : devices) {
        options.device = device.number;
        EXPECT_EQ(Renderer(options).info().device, device.number);
    }
    options.device = 99;
    const std::string message = messageOf([&] { Renderer renderer(options); }, core::ErrorKind::noRenderer);
    for (const EglDevice& device : devices)
        EXPECT_NE(message.find(std::to_string(device.number) + " (" + kindOf(device) + ")"), std::string::npos)
            << message;
}

TEST(RenderRenderer, DrawsOnAnotherThreadThanItWasMadeOn) {
    RendererOptions options = smallOptions();
    for (const Backend backend : backends()) {
        options.backend = backend;
        Renderer renderer(options);
        const image::Image here = renderer.draw(someView());
        image::Image there;
        std::thread([&] { there = renderer.draw(someView()); }).join();
        EXPECT_EQ(there.rgb, here.rgb);
    }
}

TEST(RenderRenderer, SeveralDrawAtTheSameTimeAsOneDoes) {
    const view::FrameView view = someView();
    const image::Image alone = pictureOf(view);
    std::vector<std::unique_ptr<Renderer>> renderers;
    for (int i = 0; i < 3; ++i) renderers.push_back(std::make_unique<Renderer>(smallOptions()));
    std::vector<std::thread> threads;
    std::vector<int> same(renderers.size());
    for (std::size_t i = 0; i < renderers.size(); ++i)
        threads.emplace_back([&, i] {
            for (int k = 0; k < 5; ++k) same[i] += renderers[i]->draw(view).rgb == alone.rgb ? 1 : 0;
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(same, (std::vector<int>{5, 5, 5}));
}

TEST(RenderRenderer, MeshesThatAreGoneAreForgotten) {
    const std::unique_ptr<Context> context = makeContext(backends().front());
    const CurrentContext current(*context);
    MeshCache meshes(context->gl());
    view::Surface moving = surface(view::sphereMesh(0.4F), glm::vec3(0.0F), glm::vec3(0.5F));
    for (int frame = 0; frame < 1000; ++frame) {
        moving.geometry = std::make_shared<const view::Geometry>(*moving.geometry);
        EXPECT_EQ(meshes.items({moving}).size(), 1U);
        EXPECT_LE(meshes.size(), 3U);  // the topology, this frame's geometry and at most the one before
    }
    moving = {};
    EXPECT_TRUE(meshes.items({}).empty());
    EXPECT_EQ(meshes.size(), 0U);
}

TEST(RenderRenderer, SurfaceWithoutTrianglesIsLeftOut) {
    view::FrameView view = floorView();
    const image::Image empty = pictureOf(view);
    view::Surface nothing = surface(view::sphereMesh(0.4F), glm::vec3(0.0F), glm::vec3(0.5F));
    nothing.topology = std::make_shared<const view::Topology>();
    nothing.geometry = std::make_shared<const view::Geometry>();
    view.surfaces.push_back(nothing);
    EXPECT_EQ(pictureOf(view).rgb, empty.rgb);
}

TEST(RenderRenderer, MissingShaderFolderIsNamed) {
    RendererOptions options = smallOptions();
    options.shaders = "/nowhere/shaders";
    const std::string message = messageOf([&] { Renderer renderer(options); }, core::ErrorKind::inputOutput);
    EXPECT_NE(message.find("/nowhere/shaders/"), std::string::npos) << message;
}

TEST(RenderRenderer, ShaderThatDoesNotCompileIsNamedWithTheLog) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "render_broken_shaders";
    std::filesystem::remove_all(folder);
    std::filesystem::copy(smallOptions().shaders, folder, std::filesystem::copy_options::recursive);
    std::ofstream(folder / "background.frag") << "out vec4 colour;\nvoid main() { colour = wrongName; }\n";
    RendererOptions options = smallOptions();
    options.shaders = folder;
    const std::string message = messageOf([&] { Renderer renderer(options); }, core::ErrorKind::badContent);
    EXPECT_NE(message.find("background.frag"), std::string::npos) << message;
    EXPECT_NE(message.find("wrongName"), std::string::npos) << message;
    std::filesystem::remove_all(folder);
}

TEST(RenderRenderer, MissingTextureIsNamed) {
    view::FrameView view = someView();
    view::Finish finish = *view.surfaces[0].finish;
    finish.pattern = view::Pattern::image;
    finish.texture = "/nowhere/linen.png";
    view.surfaces[0].finish = std::make_shared<const view::Finish>(finish);
    const std::string message = messageOf([&] { pictureOf(view); }, core::ErrorKind::inputOutput);
    EXPECT_NE(message.find("/nowhere/linen.png"), std::string::npos) << message;
}

TEST(RenderRenderer, SizesThatCannotBeDrawnAreRefused) {
    RendererOptions options = smallOptions();
    options.width = 1000000;
    messageOf([&] { Renderer renderer(options); }, core::ErrorKind::badContent);
    options = smallOptions();
    options.height = 0;
    messageOf([&] { Renderer renderer(options); }, core::ErrorKind::badContent);
    options = smallOptions();
    options.shadowSize = 1000;
    messageOf([&] { Renderer renderer(options); }, core::ErrorKind::badContent);
    options = smallOptions();
    options.samples = 3;
    messageOf([&] { Renderer renderer(options); }, core::ErrorKind::badContent);
}

}  // namespace
}  // namespace taut::render::test
