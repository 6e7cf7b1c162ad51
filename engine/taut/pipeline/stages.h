// Three stages that work on successive frames at the same time: simulate, draw, encode.
// It knows nothing of physics, GL or files; the stages are functions.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "taut/image/image.h"
#include "taut/view/frame_view.h"

namespace taut::pipeline {

struct Stages {
    // The next frame, or none if there are no more. Runs on its own thread.
    std::function<std::optional<view::FrameView>()> simulate;
    // Runs on the calling thread.
    std::function<image::Image(const view::FrameView&)> draw;
    // Takes the picture of a frame. Runs on a thread of its own.
    std::function<void(const view::FrameView&, image::Image&)> encode;
    // These draw other frames meanwhile, each on its own thread.
    std::vector<std::function<image::Image(const view::FrameView&)>> moreDraws{};
};

// Runs until simulate has no more frames and all of them are encoded, in order. At most two frames wait between two
// stages, and one more for each further drawer. If a stage throws, the others end after their current frame, and the
// exception of the stage that failed first is rethrown. If a frame cannot be drawn, the frames before it are still
// encoded.
void runStages(const Stages& stages);

}  // namespace taut::pipeline
