#include "taut/regression/playing.h"

#include <fmt/format.h>

#include <filesystem>

#include "taut/check/watcher.h"
#include "taut/core/error.h"
#include "taut/core/private/stopwatch.h"
#include "taut/ecs/registry.h"
#include "taut/pipeline/run.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::regression {
namespace {

report::TestCheck reported(const check::Result& result, bool broken) {
    report::TestCheck check;
    check.that = result.that;
    check.span = result.span;
    check.source =
        fmt::format("{}:{}", std::filesystem::path(result.source.file).filename().string(), result.source.line);
    const std::optional<check::Sighting>& shown = result.first ? result.first : result.worst;
    if (shown) {
        check.value = check::quantityText(shown->outcome.value, shown->outcome.unit);
        check.bound = check::quantityText(shown->outcome.bound, shown->outcome.unit);
        check.when = check::momentText(*shown);
        check.where = shown->where;
    }
    if (result.passed) return check;
    // A check that did not fail and did not run to its end has no verdict.
    check.verdict = broken && !result.first ? report::Verdict::skipped : report::Verdict::failed;
    if (check.verdict == report::Verdict::failed) check.reason = result.reason;
    return check;
}

// Of one scenario, while it is played.
class Player {
  public:
    Player(const Scenario& scenario, Drawer& drawer, const PlayOptions& options)
        : scenario_(scenario),
          drawer_(drawer),
          options_(options),
          world_(scenario.spec, {.threads = options.threads}),
          checks_(scenario.spec) {
        played_.tape = blankTape();
    }

    void play(const std::atomic<bool>& stop) {
        moment();
        const std::int64_t lastTick = lastFrame() * world_.ticksPerFrame();
        while (world_.tick() < lastTick) {
            if (stop) {
                played_.interrupted = true;
                return;
            }
            played_.divergence = world_.advance();
            if (played_.divergence) return;
            moment();
        }
    }

    Played result() {
        const bool ended = world_.tick() >= lastFrame() * world_.ticksPerFrame();
        for (const check::Result& result : checks_.results()) played_.checks.push_back(reported(result, !ended));
        played_.warnings = printed(world_.warnings());
        return std::move(played_);
    }

  private:
    std::int64_t lastFrame() const {
        std::int64_t last = pipeline::frameCount(scenario_.spec.run) - 1;
        if (options_.endsWithLastGolden) last = scenario_.goldens.empty() ? 0 : scenario_.goldens.back().frame;
        return std::min(last, options_.lastFrame.value_or(last));
    }

    // Everything that is looked at between two ticks.
    void moment() {
        addTick(played_.tape, world_, false);
        checks_.look(world_);
        if (world_.tick() % world_.ticksPerFrame() != 0) return;
        const std::int64_t frame = world_.tick() / world_.ticksPerFrame();
        for (const GoldenRequest& request : scenario_.goldens)
            if (request.frame == frame) picture(request);
    }

    void picture(const GoldenRequest& request) {
        PlayedPicture picture{request, world_.time(), world_.stateHash(), {}, {}, {}, ""};
        if (request.restart && options_.savesStates) picture.savedState = world_.save();
        try {
            const auto stored = request.restart && options_.storedState ? options_.storedState(request) : std::nullopt;
            if (stored) {
                world::World world(scenario_.spec, {.threads = options_.threads});
                world.restore(*stored);
                picture.view = viewOf(world, request);
            } else {
                picture.view = viewOf(world_, request);
            }
            picture.picture = drawer_.draw(picture.view, scenario_.spec.picture, request.size);
            played_.renderer = drawer_.renderer();
        } catch (const core::Error& error) {
            if (error.kind() == core::ErrorKind::noRenderer) throw;
            picture.fault = error.what();
        }
        played_.pictures.push_back(std::move(picture));
    }

    static view::FrameView viewOf(world::World& world, const GoldenRequest& request) {
        view::FrameView view = world.view(request.debug);
        if (!request.camera.empty())
            world.registry().each<world::CameraPart>([&](ecs::Entity, const world::CameraPart& part) {
                if (part.spec.name == request.camera) view.camera = world::cameraOf(part, world.time());
            });
        return view;
    }

    const Scenario& scenario_;
    Drawer& drawer_;
    const PlayOptions& options_;
    world::World world_;
    check::Watcher checks_;
    Played played_;
};

}  // namespace

Played playScenario(const Scenario& scenario, Drawer& drawer, const PlayOptions& options,
                    const std::atomic<bool>& stop) {
    const core::Stopwatch watch;
    Player player(scenario, drawer, options);
    player.play(stop);
    Played played = player.result();
    played.seconds = watch.seconds();
    return played;
}

}  // namespace taut::regression
