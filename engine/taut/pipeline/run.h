// Plays a scene from its start and hands its pictures on: world, renderer and files joined, and what was measured on
// the way. It knows neither scene files nor the command line.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "taut/image/frame_sink.h"
#include "taut/pipeline/record_log.h"
#include "taut/view/frame_view.h"
#include "taut/world/world.h"

namespace taut::pipeline {

// How many pictures a scene has: frame 0 is its start, frame k shows k / fps; at least 1.
std::int64_t frameCount(const world::RunSpec& run);

// What turns a view into a picture.
using Draw = std::function<image::Image(const view::FrameView&)>;

struct RunOptions {
    std::int64_t firstFrame = 0;  // frames before it are simulated and not drawn
    std::int64_t lastFrame = 0;   // included
    bool debugView = false;
    bool metrics = false;
    std::function<std::vector<double>(const world::World&)> figures{};  // measured each frame; null: nothing
    FigureColumns figureColumns{};                                      // that they fill

    // The shutter is open for `shutter` of the time from frame to frame, half of it before the frame's own moment, and
    // so many moments are drawn of it; 0: one, without blur.
    int blurMoments = 0;
    double shutter = 0.5;

    // The camera's, with film 24 mm high; 0: all is sharp. What is sharp is `focus` [m] ahead; 0: as far as the target.
    double fStop = 0.0;
    double focus = 0.0;

    // Other frames are drawn by these at the same time, each on a thread of its own; a picture may not depend on which
    // draws it.
    std::vector<Draw> moreDraws{};
    // Called for each picture, in order, before it goes to the sink; null: nothing is done.
    std::function<void(const view::FrameView&, image::Image&)> finishPicture{};

    std::int64_t startFrame = 0;       // where to go on: the world is at the time of this frame already
    std::int64_t checkpointEvery = 0;  // [frames] the listener gets the state so often; 0: never
};

// The world as it is now, as the picture of a run shows it: with marks, an open shutter and a lens as asked for.
view::FrameView shownNow(const world::World& world, const RunOptions& options);

// Hears of progress; every function may be left empty. They are called from several threads, never two at a time for
// the same function, and in ascending order.
struct RunListener {
    std::function<void(const FrameRecord&)> frameSimulated{};  // before its picture is drawn
    std::function<void(const FrameRecord&)> frameDone{};
    std::function<void(std::int64_t tick, std::uint64_t hash)> tickDone{};
    // The state that goes on with `frame`, and the records of the frames before, whose pictures are on disk.
    std::function<void(std::int64_t frame, std::vector<std::byte> state, const RecordLog& before)> checkpoint{};
};

struct RunResult {
    RecordLog frames;  // every simulated one, those before the start among them
    std::optional<world::Divergence> divergence;
    bool interrupted = false;
    double seconds = 0.0;  // [s] of wall time, the whole run
};

// Plays frames startFrame … lastFrame. With `draw`, which is called on this thread, and `sink` the frames from
// firstFrame on are drawn and written while the next ones are simulated; without them nothing is drawn. Ends early,
// with everything that was begun finished, when the state diverges or `stop` becomes true; the sink is finished in any
// case but an exception. Rethrows what a stage throws. `records` are those of the frames before startFrame; none are
// needed at 0.
RunResult play(world::World& world, const RunOptions& options, const Draw& draw, image::FrameSink* sink,
               const RunListener& listener, const std::atomic<bool>& stop, std::optional<RecordLog> records = {});

}  // namespace taut::pipeline
