#include "game/render_stills.h"

#include <cstdlib>
#include <memory>
#include <utility>

#include "game/exit_code.h"
#include "game/folders.h"
#include "game/interruption.h"
#include "game/messages.h"
#include "game/outputs.h"
#include "game/progress.h"
#include "game/renderers.h"
#include "game/scene_file.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/core/private/stopwatch.h"
#include "taut/pipeline/overlay.h"
#include "taut/spec/ticks.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

// The ticks of the moments, ascending as they are. A scene of 2 s has a moment at 2 s, though no frame.
std::vector<std::int64_t> ticksOf(const std::vector<std::string>& moments, const world::RunSpec& run) {
    std::vector<std::int64_t> ticks;
    for (const std::string& text : moments) {
        const double t = std::strtod(text.c_str(), nullptr);
        if (t > run.seconds)
            failUsage("--at {}: the scene lasts {} s; --seconds {} makes it longer", text, run.seconds, text);
        ticks.push_back(world::Ticks(run).at(t));
        if (run.startState != nullptr && ticks.back() < run.startState->tick)
            failUsage("--at {}: the scene starts at {:.6g} s, from {}", text,
                      world::Ticks(run).secondsOf(run.startState->tick), run.start);
        if (ticks.size() > 1 && ticks.back() <= ticks[ticks.size() - 2])
            failUsage("--at {}: not a tick after the moment before", text);
    }
    return ticks;
}

void permitStills(const RenderFlags& flags, const image::FramePattern& pattern) {
    for (std::size_t i = 0; i < flags.at.size(); ++i)
        for (const image::FramePattern& files : pattern.with(filesBeside(flags.layers)))
            permitOverwritingFile(files.pathOf(static_cast<std::int64_t>(i)), flags.overwrite.answer());
}

// One world on its way from moment to moment.
class Walk {
  public:
    Walk(const RenderFlags& flags, const world::SceneSpec& spec, std::int64_t last)
        : world(spec, {.threads = flags.threads}),
          overlay_(fontFile(), pipeline::smallestStep(world)),
          isMeasured_(flags.overlay),
          progress_(factsOf(spec, last), flags.quiet) {
        hear();
    }

    // False when `stop` became true.
    bool advanceTo(std::int64_t tick, const std::atomic<bool>& stop) {
        while (world.tick() < tick) {
            if (stop) return false;
            if (const auto divergence = world.advance())
                throw core::Error(core::ErrorKind::diverged, divergence->message);
            if (world.tick() % world.ticksPerFrame() == 0 || world.tick() == tick) hear();
        }
        return true;
    }

    void finish(image::Image& picture) {
        if (isMeasured_) overlay_.paint(picture, world.time());
    }

    world::World world;

  private:
    ProgressFacts factsOf(const world::SceneSpec& spec, std::int64_t last) const {
        return {last / world.ticksPerFrame() + 1, spec.run.fps, pipeline::smallestStep(world)};
    }

    void hear() {
        pipeline::FrameRecord record{.frame = world.tick() / world.ticksPerFrame(), .time = world.time()};
        record.simulating = watch_.restart();
        if (isMeasured_) {
            record.metrics = world.metrics();
            overlay_.add({*record.metrics, world.tick()});
        }
        progress_.frameDone(record);
    }

    pipeline::Overlay overlay_;
    bool isMeasured_;
    Progress progress_;
    core::Stopwatch watch_;
};

}  // namespace

int renderStills(const RenderFlags& flags) {
    const world::SceneSpec spec = readScene(flags.scene, allOverrides(flags), flags.isConfined);
    const std::vector<std::int64_t> ticks = ticksOf(flags.at, spec.run);
    const image::FramePattern pattern = framePattern(flags);
    permitStills(flags, pattern);
    const Interruption interruption;
    if (!flags.quiet) notePreparation(spec);
    const core::ThreadLimit threads(flags.threads);
    Walk walk(flags, spec, ticks.back());
    printWarnings(walk.world.warnings());

    pipeline::RunOptions options;
    options.debugView = flags.debug;
    expose(flags.layers, spec, flags.threads, options);
    const pipeline::PictureLayers layers = layersOf(flags.layers, walk.world);
    const auto renderer = makeRenderer(spec.picture, flags.threads, flags.gl, layers);
    image::FrameSequence pictures(pattern);
    image::LayerSequence besides(pattern);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        if (!walk.advanceTo(ticks[i], interruption.flag())) break;
        image::Image picture = renderer->draw(pipeline::shownNow(walk.world, options));
        walk.finish(picture);
        const auto number = static_cast<std::int64_t>(i);
        pictures.write(number, picture);
        besides.write(number, picture);
        if (!flags.quiet)
            printNote("{}: {:.6g} s, tick {}\n", pattern.pathOf(number).string(), walk.world.time(), ticks[i]);
    }
    return static_cast<int>(interruption.exitCode().value_or(ExitCode::ok));
}

}  // namespace taut::game
