// Processor time of a picture of 1280 × 720, pass by pass: the shipped scenes under a still and under their
// own camera, with GL's own threads off. The counters are milliseconds a picture of each pass; waiting for GL between
// them adds a little. `view` is the work before: the drawn surfaces.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdlib>
#include <map>

#include "taut/render/renderer.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut {
namespace {

constexpr int firstFrame = 60, frames = 12;

double processorTime() {  // [ms]
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto of = [](const timeval& t) {
        return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
    };
    return of(used.ru_utime) + of(used.ru_stime);
}

// milliseconds: of processor time for a view.
std::vector<view::FrameView> viewsOf(const world::SceneSpec& spec, double& milliseconds) {
    world::World world(spec, {.threads = 1});
    std::vector<view::FrameView> views{world.view(false)};  // constant data is made
    views.clear();
    milliseconds = 0.0;
    for (int frame = 0; frame < firstFrame + frames; ++frame) {
        const double before = processorTime();
        if (frame >= firstFrame) views.push_back(world.view(false));
        milliseconds += (processorTime() - before) / frames;
        for (int tick = 0; tick < world.ticksPerFrame(); ++tick) (void)world.advance();
    }
    return views;
}

void drawScene(benchmark::State& state, const char* name, bool isCameraStill, int smooth = 0) {
    const std::filesystem::path assets = std::filesystem::path(TAUT_SOURCE_DIR) / "assets";
    const std::filesystem::path file = assets / "scenes" / (std::string(name) + ".toml");
    world::SceneSpec spec = scene::loadScene(file, {.assetFolders = {assets}}).spec;
    spec.picture.smooth = smooth;
    double viewing = 0.0;
    std::vector<view::FrameView> views = viewsOf(spec, viewing);
    for (view::FrameView& view : views)
        if (isCameraStill) view.camera = views.front().camera;

    std::map<std::string, double, std::less<>> passes;
    double before = 0.0;
    render::RendererOptions options;
    options.shadowSize = spec.picture.shadowSize;
    options.shaders = std::filesystem::path(TAUT_SOURCE_DIR) / "shaders";
    options.passDone = [&](std::string_view pass) {
        const double now = processorTime();
        passes[std::string(pass)] += now - before;
        before = now;
    };
    render::Renderer renderer(options);
    for (int i = 0; i < 3; ++i) (void)renderer.draw(views[i]);  // programs are made
    passes.clear();
    double pictures = 0.0;
    for (auto _ : state) {
        before = processorTime();
        benchmark::DoNotOptimize(renderer.draw(views[static_cast<std::size_t>(pictures) % views.size()]));
        pictures += 1.0;
    }
    for (const auto& [pass, time] : passes) state.counters[pass] = time / pictures;
    state.counters["view"] = viewing;
}

#define TAUT_DRAWS(scene)                                                                                 \
    BENCHMARK_CAPTURE(drawScene, scene##_still, #scene, true)->Unit(benchmark::kMillisecond)->MinTime(2); \
    BENCHMARK_CAPTURE(drawScene, scene##_moving, #scene, false)->Unit(benchmark::kMillisecond)->MinTime(2)
TAUT_DRAWS(drape);
TAUT_DRAWS(flag);
TAUT_DRAWS(curtain);
TAUT_DRAWS(poncho);
TAUT_DRAWS(show);
TAUT_DRAWS(dress);
TAUT_DRAWS(laundry);

#define TAUT_DRAWS_FINER(scene)                                                                                    \
    BENCHMARK_CAPTURE(drawScene, scene##_as_computed, #scene, true, 0)->Unit(benchmark::kMillisecond)->MinTime(2); \
    BENCHMARK_CAPTURE(drawScene, scene##_finer, #scene, true, 1)->Unit(benchmark::kMillisecond)->MinTime(2)
TAUT_DRAWS_FINER(drape);
TAUT_DRAWS_FINER(laundry);

}  // namespace
}  // namespace taut

int main(int count, char** arguments) {
    ::setenv("LP_NUM_THREADS", "0", 0);
    benchmark::Initialize(&count, arguments);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
