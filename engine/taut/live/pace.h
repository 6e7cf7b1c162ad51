// Counts the ticks that are due for the next picture, and tells where between two ticks this picture lies. It knows no
// clock: the caller says how much time has passed.
#pragma once

namespace taut::live {

class Pace {
  public:
    explicit Pace(double tickSeconds) : tickSeconds_(tickSeconds) {}

    // Adds `wall` seconds at `speed` (1 is real time) and returns the whole ticks that are due, at most `most`. Ticks
    // beyond `most` are forgotten: if the machine is too slow, motion gets slower, and a picture never gets more ticks.
    int due(double wall, double speed, int most);

    // Says that so many due ticks were not done. A few of them become due again, so that no motion is lost if the
    // machine is held up for a moment.
    void owe(int ticks);

    // The place between the last tick and the next, 0 … 1.
    double share() const { return waiting_; }

  private:
    double tickSeconds_;
    double waiting_ = 0.0;  // [ticks]
    int owed_ = 0;
};

}  // namespace taut::live
