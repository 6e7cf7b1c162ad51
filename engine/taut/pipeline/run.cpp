#include "taut/pipeline/run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "taut/core/error.h"
#include "taut/core/private/stopwatch.h"
#include "taut/pipeline/stages.h"
#include "taut/spec/ticks.h"
#include "taut/world/world.h"

namespace taut::pipeline {
namespace {

void addMoments(const world::World& world, const RunOptions& options, view::FrameView& view) {
    const double open = options.shutter * world.ticksPerFrame() * world.tickSeconds();
    for (int i = 0; i < options.blurMoments; ++i) {
        view.moments.push_back(world.viewAhead(open * ((i + 0.5) / options.blurMoments - 0.5)));
        view.moments.back().marks = view.marks;
        view.moments.back().showMarks = view.showMarks;
    }
}

void openLens(const RunOptions& options, view::Camera& camera) {
    if (!(options.fStop > 0.0)) return;
    constexpr double halfFilm = 0.012;  // [m]
    const double focalLength = halfFilm / std::tan(0.5 * static_cast<double>(camera.fieldOfView));
    camera.lensRadius = static_cast<float>(0.5 * focalLength / options.fStop);
    camera.focus = options.focus > 0.0 ? static_cast<float>(options.focus) : glm::distance(camera.eye, camera.target);
}

// The simulating side of a run. Its records wait in `pending_` until the picture of their frame is on disk.
class Player {
  public:
    Player(world::World& world, const RunOptions& options, const RunListener& listener, const std::atomic<bool>& stop,
           RecordLog records)
        : world_(world), options_(options), listener_(listener), stop_(stop), next_(options.startFrame) {
        TAUT_EXPECTS(world.tick() == next_ * world.ticksPerFrame());
        TAUT_EXPECTS(static_cast<std::int64_t>(records.size()) == next_);
        result_.frames = std::move(records);
    }

    // Simulates up to the next frame; false at the end, on divergence and when stopped.
    bool advance() {
        if (next_ > options_.lastFrame || result_.divergence || result_.interrupted) return false;
        const core::Stopwatch watch;
        const std::int64_t goal = next_ * world_.ticksPerFrame();
        while (world_.tick() < goal) {
            if (stop_) return !(result_.interrupted = true);
            result_.divergence = world_.advance();
            if (result_.divergence) return false;
            if (listener_.tickDone) listener_.tickDone(world_.tick(), world_.stateHash());
        }
        if (stop_) return !(result_.interrupted = true);
        if (next_ == 0 && listener_.tickDone) listener_.tickDone(0, world_.stateHash());
        current_ = FrameRecord{.frame = next_++, .time = world_.time(), .hash = world_.stateHash()};
        saveState();
        if (options_.metrics) current_.metrics = world_.metrics();
        if (options_.figures) current_.figures = options_.figures(world_);
        current_.simulating = watch.seconds();
        if (listener_.frameSimulated) listener_.frameSimulated(current_);
        return true;
    }

    // For a frame without a picture.
    void keep() { finish(current_); }

    std::optional<view::FrameView> nextView() {
        while (advance()) {
            if (current_.frame < options_.firstFrame) {
                keep();
                continue;
            }
            const core::Stopwatch watch;
            view::FrameView view = shownNow(world_, options_);
            current_.simulating += watch.seconds();
            current_.pictured = true;
            const std::lock_guard lock(mutex_);
            pending_[current_.frame] = current_;
            return view;
        }
        return std::nullopt;
    }

    // Called by the stages that draw and encode, on their threads.
    void drawn(std::int64_t frame, double seconds) {
        const std::lock_guard lock(mutex_);
        pending_.at(frame).drawing = seconds;
    }

    void encoded(std::int64_t frame, double seconds) {
        FrameRecord record;
        {
            const std::lock_guard lock(mutex_);
            record = pending_.extract(frame).mapped();
        }
        record.encoding = seconds;
        finish(record);
    }

    RunResult& result() { return result_; }

  private:
    // The state of the current frame waits until the frames before are on disk.
    void saveState() {
        const std::int64_t frame = current_.frame, every = options_.checkpointEvery;
        if (every == 0 || frame % every != 0 || frame == options_.startFrame) return;
        std::vector<std::byte> state = world_.save();
        const std::lock_guard lock(mutex_);
        states_[frame] = std::move(state);
    }

    void finish(const FrameRecord& record) {
        std::vector<std::byte> state;
        {
            const std::lock_guard lock(mutex_);
            if (auto saved = states_.extract(record.frame)) state = std::move(saved.mapped());
        }
        if (!state.empty() && listener_.checkpoint)
            listener_.checkpoint(record.frame, std::move(state), result_.frames);
        result_.frames.add(record);
        if (listener_.frameDone) listener_.frameDone(record);
    }

    world::World& world_;
    const RunOptions& options_;
    const RunListener& listener_;
    const std::atomic<bool>& stop_;
    RunResult result_;
    FrameRecord current_;
    std::int64_t next_;
    std::mutex mutex_;
    std::map<std::int64_t, FrameRecord> pending_;  // simulated, not yet on disk
    std::map<std::int64_t, std::vector<std::byte>> states_;
};

}  // namespace

view::FrameView shownNow(const world::World& world, const RunOptions& options) {
    view::FrameView view = world.view(options.debugView);
    addMoments(world, options, view);
    openLens(options, view.camera);
    if (options.ahead) view.next = options.ahead(world);
    return view;
}

std::int64_t frameCount(const world::RunSpec& run) {
    return world::Ticks(run).lastFrame + 1;
}

RunResult play(world::World& world, const RunOptions& options, const Draw& draw, image::FrameSink* sink,
               const RunListener& listener, const std::atomic<bool>& stop, std::optional<RecordLog> records) {
    TAUT_EXPECTS(options.firstFrame >= 0 && options.firstFrame <= options.lastFrame);
    TAUT_EXPECTS(!draw == (sink == nullptr));
    const core::Stopwatch whole;
    if (!records) records.emplace(options.figureColumns);
    Player player(world, options, listener, stop, std::move(*records));
    if (!draw) {
        while (player.advance()) player.keep();
    } else {
        const auto timed = [&player](const Draw& drawOne) -> Draw {
            return [&player, &drawOne](const view::FrameView& view) {
                const core::Stopwatch watch;
                image::Image picture = drawOne(view);
                player.drawn(view.frame, watch.seconds());
                return picture;
            };
        };
        Stages stages;
        stages.simulate = [&] { return player.nextView(); };
        stages.draw = timed(draw);
        for (const Draw& more : options.moreDraws) stages.moreDraws.push_back(timed(more));
        stages.encode = [&](const view::FrameView& view, image::Image& picture) {
            const core::Stopwatch watch;
            if (options.finishPicture) options.finishPicture(view, picture);
            sink->write(view.frame, picture);
            player.encoded(view.frame, watch.seconds());
        };
        runStages(stages);
        sink->finish();
    }
    RunResult result = std::move(player.result());
    result.seconds = whole.seconds();
    return result;
}

}  // namespace taut::pipeline
