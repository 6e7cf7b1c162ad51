// Tells a person how far a run is: one live line on a terminal, a line now and then otherwise. It knows no world.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "game/live_line.h"
#include "taut/pipeline/overlay.h"
#include "taut/pipeline/run.h"

namespace taut::game {

// A duration for people: "0:07", "12:05", "1:02:05".
std::string clockText(double seconds);

// The constants of a run.
struct ProgressFacts {
    std::int64_t frames = 1;  // to simulate
    double fps = 60.0;        // pictures a second of scene time
    pipeline::SmallestStep step{};
    std::optional<double> firstEnergy{};  // [J] at the start of the run; none: of the first record that has metrics
};

class Progress {
  public:
    Progress(const ProgressFacts& facts, bool quiet);

    void frameDone(const pipeline::FrameRecord& record);

    // The line for a record, without a line end; elapsed and left are wall time [s].
    std::string line(const pipeline::FrameRecord& record, double elapsed, double left);

  private:
    using Clock = std::chrono::steady_clock;

    double secondsLeft(const pipeline::FrameRecord& record, Clock::time_point now);

    ProgressFacts facts_;
    LiveLine line_;
    Clock::time_point start_ = Clock::now();
    // Where the pace is measured from: the start, or the first picture, because frames without one pass faster.
    Clock::time_point paceStart_ = start_;
    std::int64_t paceFrame_ = -1;
    bool pictured_ = false;
};

}  // namespace taut::game
