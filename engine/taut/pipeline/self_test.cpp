#include "taut/pipeline/self_test.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>

#include "taut/core/error.h"
#include "taut/core/private/stopwatch.h"
#include "taut/view/frame_view.h"

namespace taut::pipeline {
namespace {

// A red triangle facing the camera: it covers the middle of the picture and leaves its upper corners free.
view::FrameView testView() {
    view::FrameView view;
    view.camera.eye = {0.0F, 0.0F, 3.0F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    view.light.direction = {0.0F, 0.0F, -1.0F};

    view::Topology topology;
    topology.triangles = {0, 1, 2};
    topology.uv = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.5F, 1.0F}};
    view::Geometry geometry;
    geometry.positions = {{-0.9F, -0.7F, 0.0F}, {0.9F, -0.7F, 0.0F}, {0.0F, 0.9F, 0.0F}};
    geometry.normals.assign(3, {0.0F, 0.0F, 1.0F});
    view::Finish finish;
    finish.front = finish.back = {0.8F, 0.02F, 0.02F};

    view::Surface triangle;
    triangle.name = "test";
    triangle.topology = std::make_shared<const view::Topology>(std::move(topology));
    triangle.geometry = std::make_shared<const view::Geometry>(std::move(geometry));
    triangle.finish = std::make_shared<const view::Finish>(finish);
    triangle.twoSided = true;
    view.surfaces.push_back(std::move(triangle));
    return view;
}

std::array<int, 3> pixel(const image::Image& image, int x, int y) {
    const std::size_t at =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 3;
    return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

bool isRed(std::array<int, 3> c) {
    return c[0] > 40 && c[0] > 2 * c[1] && c[0] > 2 * c[2];
}

}  // namespace

std::string nameOf(render::Backend backend) {
    return backend == render::Backend::osmesa ? "osmesa" : "egl";
}

void testRenderer(render::Renderer& renderer) {
    const image::Image picture = renderer.draw(testView());
    const render::RendererInfo info = renderer.info();
    const auto fail = [&](const std::string& what) {
        throw core::Error(core::ErrorKind::noRenderer, fmt::format("{}: {} ({}, {}, OpenGL {})", info.backend, what,
                                                                   info.vendor, info.renderer, info.version));
    };
    if (!picture.isWhole()) fail("drew no picture");
    const bool blank =
        std::ranges::all_of(picture.rgb, [&](std::uint8_t value) { return value == picture.rgb.front(); });
    if (blank) fail("drew a blank picture");
    if (!isRed(pixel(picture, picture.width / 2, picture.height / 2)))
        fail("did not draw the test triangle where it belongs");
    if (isRed(pixel(picture, 0, 0)) || isRed(pixel(picture, picture.width - 1, 0)))
        fail("drew the test triangle where it does not belong");
}

TestDrawing drawTest(render::Renderer& renderer, int times) {
    TAUT_EXPECTS(times >= 1);
    view::FrameView view = testView();
    view.camera.eye = {0.0F, 0.6F, 4.0F};
    view.light.direction = {0.4F, -1.0F, -0.8F};
    view.ground = view::Ground{};
    view.ground->height = -0.8F;
    TestDrawing drawing{renderer.draw(view), 0.0};
    std::vector<double> seconds;
    for (int i = 0; i < times; ++i) {
        view.camera.eye.x = 0.01F * static_cast<float>(i + 1);  // nothing is kept from the picture before
        const core::Stopwatch watch;
        (void)renderer.draw(view);
        seconds.push_back(watch.seconds());
    }
    std::nth_element(seconds.begin(), seconds.begin() + times / 2, seconds.end());
    drawing.seconds = seconds[times / 2];
    return drawing;
}

std::string memoryShortage(int threads) {
    // [bytes] of addresses that llvmpipe takes, with the heaps of its threads: 450 MB for one and a small picture.
    constexpr std::size_t first = std::size_t{500} << 20U, more = std::size_t{400} << 20U;
    ::rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) threads = 1;
    const std::size_t needed = first + more * static_cast<std::size_t>(std::max(threads, 1) - 1);
    void* const memory = ::mmap(nullptr, needed, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
        return fmt::format("a renderer{} takes {} MB of memory, and there is less; raise the limit (ulimit -v){}",
                           threads > 1 ? fmt::format(" with {} threads", threads) : "", needed >> 20U,
                           threads > 1 ? " or take fewer --threads" : "");
    ::munmap(memory, needed);
    return "";
}

std::unique_ptr<render::Renderer> workingRenderer(render::RendererOptions options,
                                                  const std::vector<render::Backend>& backends) {
    TAUT_EXPECTS(!backends.empty());
    std::string tried;
    for (const render::Backend backend : backends) {
        options.backend = backend;
        try {
            auto renderer = std::make_unique<render::Renderer>(options);
            testRenderer(*renderer);
            return renderer;
        } catch (const core::Error& error) {
            if (error.kind() != core::ErrorKind::noRenderer) throw;
            tried += fmt::format("\n  {}: {}", nameOf(backend), error.what());
        }
    }
    if (const std::string shortage = memoryShortage(); !shortage.empty())
        throw core::Error(core::ErrorKind::noRenderer, "nothing here can draw: " + shortage);
    const bool hasOsmesa = render::backends().front() == render::Backend::osmesa;
    throw core::Error(
        core::ErrorKind::noRenderer,
        fmt::format("nothing here can draw. Tried:{}\nInstall the packages {} and libgl1-mesa-dri, or choose another "
                    "with --gl.",
                    tried, hasOsmesa ? "libosmesa6-dev" : "libegl-mesa0"));
}

}  // namespace taut::pipeline
