// The figures of a run in a corner of its pictures: time, step and limit, strain, and the energies as a small graph.
// It knows neither the world nor GL; a picture depends on the moments that it was told of and on nothing else.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "taut/image/image.h"
#include "taut/island/report.h"
#include "taut/pipeline/painting.h"

namespace taut::world {
class World;
}  // namespace taut::world

namespace taut::pipeline {

// The step of the island that has the smallest, and what else holds from the start.
struct StepFacts {
    double step = 0.0;         // [s]
    double limit = 0.0;        // [s] largest stable; infinite: none
    bool bodiesTouch = false;  // each other, or themselves
};
StepFacts smallestStep(const world::World& world);

struct Moment : world::Metrics {
    std::int64_t tick = 0;
};

// A name and its value: a line of the panel above those of the run.
using OverlayLine = std::pair<std::string, std::string>;

// Where and how they are painted.
struct OverlayLook {
    bool isAtRight = false;  // in the upper right corner instead of the left
    float opacity = 1.0F;    // 0 (nothing is seen) … 1
    float density = 1.0F;    // pixels of the screen for one of a common screen: how much larger the type is
};

// add() and paint() may be called from two threads at the same time.
class Overlay {
  public:
    static constexpr double span = 4.0;  // [s] that the graph shows

    // An empty font stands for the one that Debian installs. Throws core::Error(inputOutput, badContent) of the font.
    Overlay(const std::filesystem::path& font, const StepFacts& step);

    // Ascending in time.
    void add(const Moment& moment);

    // Paints what was the case at `time` [s]: the last moment not after it, and those before. Forgets what no later
    // picture will show. Nothing is painted before the first moment. Small pictures have the figures without the graph.
    // Returns what it covers.
    Box paint(image::Image& picture, double time, std::span<const OverlayLine> above = {},
              const OverlayLook& look = {});

    // For text of the same kind elsewhere in the picture.
    render::TextPainter& letters() { return letters_; }

  private:
    render::TextPainter letters_;
    StepFacts step_;
    std::mutex mutex_;
    std::deque<Moment> moments_;
};

// [px] size of the type that reads well in a picture of this height on a screen of this density.
float typeSize(int pictureHeight, float density = 1.0F);

}  // namespace taut::pipeline
