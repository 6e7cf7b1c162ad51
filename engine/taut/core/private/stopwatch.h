// Wall time since a moment, for reports. It is never used in a calculation.
#pragma once

#include <chrono>

namespace taut::core {

class Stopwatch {
  public:
    // [s] since it was made, or since the last restart().
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    double restart() {
        const double passed = seconds();
        start_ = Clock::now();
        return passed;
    }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

}  // namespace taut::core
