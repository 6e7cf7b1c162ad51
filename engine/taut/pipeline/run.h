// Plays a scene from its start and passes its pictures on. It connects world, renderer and files, and returns the
// measurements. Independent of scene files and the command line.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "taut/image/frame_sink.h"
#include "taut/pipeline/frame_ahead.h"
#include "taut/pipeline/record_log.h"
#include "taut/view/frame_view.h"

namespace taut::world {
struct RunSpec;
class World;
}  // namespace taut::world

namespace taut::pipeline {

// How many pictures a scene has: frame 0 is its start, frame k shows k / fps; at least 1.
std::int64_t frameCount(const world::RunSpec& run);

// Turns a view into a picture.
using Draw = std::function<image::Image(const view::FrameView&)>;

struct RunOptions {
    std::int64_t firstFrame = 0;  // frames before it are simulated and not drawn
    std::int64_t lastFrame = 0;   // included
    bool debugView = false;
    bool metrics = false;
    std::function<std::vector<double>(const world::World&)> figures{};  // measured in each frame; null: nothing
    FigureColumns figureColumns{};                                      // that they fill

    // Motion blur. The shutter is open for the share `shutter` of the time from frame to frame, half of it before the
    // frame's own moment. So many moments of it are drawn; 0: one, without blur.
    int blurMoments = 0;
    double shutter = 0.5;

    // Depth of field of a camera with film 24 mm high; 0: all is sharp. Things `focus` [m] ahead are sharp; 0: at the
    // distance of the target.
    double fStop = 0.0;
    double focus = 0.0;

    FrameAhead ahead{};  // FrameView::next of each picture; null: there is none

    // These draw other frames at the same time, each on its own thread. A picture may not depend on which one draws it.
    std::vector<Draw> moreDraws{};
    // Called for each picture, in order, before it goes to the sink; null: nothing is called.
    std::function<void(const view::FrameView&, image::Image&)> finishPicture{};

    std::int64_t startFrame = 0;       // the first frame to play: the world is at its time already
    std::int64_t checkpointEvery = 0;  // [frames] the listener gets the state so often; 0: never
};

// The world as it is now, as the picture of a run shows it: with marks, an open shutter, a lens and the next frame as
// asked for.
view::FrameView shownNow(const world::World& world, const RunOptions& options);

// Callbacks for progress; every function may be empty. Several threads call them, but never two the same function at
// the same time, and frames ascend.
struct RunListener {
    std::function<void(const FrameRecord&)> frameSimulated{};  // before its picture is drawn
    std::function<void(const FrameRecord&)> frameDone{};
    std::function<void(std::int64_t tick, std::uint64_t hash)> tickDone{};
    // Gets the state from which a run goes on with `frame`, and the records of the frames before; their pictures are on
    // disk.
    std::function<void(std::int64_t frame, std::vector<std::byte> state, const RecordLog& before)> checkpoint{};
};

struct RunResult {
    RecordLog frames;  // all simulated ones, also those before the start
    std::optional<world::Divergence> divergence;
    bool interrupted = false;
    double seconds = 0.0;  // [s] of wall time, the whole run
};

// Plays frames startFrame … lastFrame. If `draw` and `sink` are given, the frames from firstFrame on are drawn and
// written while the next ones are simulated; without them nothing is drawn. `draw` is called on this thread. The run
// ends early if the state diverges or `stop` becomes true; it then finishes all frames in progress. The sink is
// finished unless there is an exception. Rethrows exceptions of a stage. `records` are those of the frames before
// startFrame; 0 needs none.
RunResult play(world::World& world, const RunOptions& options, const Draw& draw, image::FrameSink* sink,
               const RunListener& listener, const std::atomic<bool>& stop, std::optional<RecordLog> records = {});

}  // namespace taut::pipeline
