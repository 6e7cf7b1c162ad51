// How many ticks are due when a picture is to be drawn, and where between two ticks that picture is. It knows no clock:
// it is told how much time has passed.
#pragma once

namespace taut::live {

class Pace {
  public:
    explicit Pace(double tickSeconds) : tickSeconds_(tickSeconds) {}

    // Takes in `wall` seconds at `speed` (1 is real time) and returns the whole ticks that are due, `most` at most; the
    // rest of those is forgotten: motion gets slower where the machine is too slow, and never more ticks a picture.
    int due(double wall, double speed, int most);

    // So many of those that were due have not been done: they are due with the next, a few of them, so that a moment in
    // which the machine is held up costs no motion.
    void owe(int ticks);

    // How far it is from the last tick to the next, 0 … 1.
    double share() const { return waiting_; }

  private:
    double tickSeconds_;
    double waiting_ = 0.0;  // [ticks]
    int owed_ = 0;
};

}  // namespace taut::live
