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
    // The next frame, or none when there are no more. Runs on a thread of its own.
    std::function<std::optional<view::FrameView>()> simulate;
    // Runs on the calling thread.
    std::function<image::Image(const view::FrameView&)> draw;
    // Takes the picture of a frame. Runs on a thread of its own.
    std::function<void(const view::FrameView&, image::Image&)> encode;
    // Draw other frames meanwhile, each on a thread of its own.
    std::vector<std::function<image::Image(const view::FrameView&)>> moreDraws{};
};

// Runs until simulate has no more and everything it gave is encoded, in order; at most two frames wait between two
// stages, and one more for each that draws besides. When a stage throws, the others end after the frame that they have
// in hand, and the exception of the stage that failed first is rethrown; frames before one that cannot be drawn are
// encoded.
void runStages(const Stages& stages);

}  // namespace taut::pipeline
