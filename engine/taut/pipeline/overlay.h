// The figures of a run in a corner of its pictures: time, step and limit, strain, and the energies as a small graph.
// Independent of the world and of GL. The painting depends only on the moments that were added.
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

// The smallest step of all islands, and other constants of the run.
struct SmallestStep {
    double step = 0.0;          // [s]
    double limit = 0.0;         // [s] largest stable; infinite: none
    bool bodiesTouch = false;   // each other, or themselves
    bool followsState = false;  // the step follows the state, below the limit of each state
};
// "0.196, limit 0.217 ms"; without a limit where the step follows the state.
std::string stepText(const SmallestStep& step);
SmallestStep smallestStep(const world::World& world);

struct Moment : world::Metrics {
    std::int64_t tick = 0;
};

// A name and its value: a line of the panel above those of the run.
using OverlayLine = std::pair<std::string, std::string>;

// Where and how they are painted.
struct OverlayLook {
    bool isAtRight = false;  // in the upper right corner instead of the left
    float opacity = 1.0F;    // 0 (nothing is seen) … 1
    float density = 1.0F;    // pixels of the screen per pixel of a common screen: the factor of the type size
};

// add() and paint() may be called from two threads at the same time.
class Overlay {
  public:
    static constexpr double span = 4.0;  // [s] that the graph shows

    // An empty path means the font that Debian installs. Throws core::Error(inputOutput, badContent) of the font.
    Overlay(const std::filesystem::path& font, const SmallestStep& step);

    // Ascending in time.
    void add(const Moment& moment);

    // Paints the figures at `time` [s], from the last moment that is not after it and the moments before. It forgets
    // moments that no later picture will show. Before the first moment it paints nothing. Small pictures get the
    // figures without the graph. Returns the box that it covers.
    PictureBox paint(image::Image& picture, double time, std::span<const OverlayLine> above = {},
                     const OverlayLook& look = {});

    // For text of the same kind elsewhere in the picture.
    render::TextPainter& letters() { return letters_; }

  private:
    render::TextPainter letters_;
    SmallestStep step_;
    std::mutex mutex_;
    std::deque<Moment> moments_;
};

// [px] a readable type size for a picture of this height on a screen of this density.
float typeSize(int pictureHeight, float density = 1.0F);

}  // namespace taut::pipeline
