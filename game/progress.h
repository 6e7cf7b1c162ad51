// Tells a person how far a run is: one live line on a terminal, a line now and then otherwise. It knows no world.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "pipeline/run.h"

namespace taut::game {

// A duration for people: "0:07", "12:05", "1:02:05".
std::string clockText(double seconds);

class Progress {
  public:
    // step: the smallest h of the islands [s]; fps: pictures a second of scene time.
    Progress(std::int64_t frames, double fps, double step, bool quiet);
    ~Progress();  // ends the live line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void frameDone(const pipeline::FrameRecord& record);

    // The line for a record, without a line end.
    std::string line(const pipeline::FrameRecord& record, double elapsed) const;

  private:
    using Clock = std::chrono::steady_clock;

    std::int64_t frames_;
    double fps_;
    double step_;
    bool quiet_;
    bool live_;
    bool lineOpen_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point lastShown_;
};

}  // namespace taut::game
