// Finds the finest level of drawing that is fast enough, while pictures are drawn. Independent of the levels and of
// clocks: the caller passes durations.
#pragma once

#include <vector>

namespace taut::live {

class Adaptation {
  public:
    // `costs`: of a picture at each level, in any unit, ascending. It begins at `level`. A turn, from one picture to
    // the next, should take no longer than `goal` [s].
    Adaptation(std::vector<double> costs, int level, double goal);

    // Call it after a turn with the time of the picture, and of the whole turn without idling [s]. Returns whether the
    // level has changed. A turn that is too long for another reason than the picture changes nothing.
    bool add(double drawing, double turn);

    int level() const { return level_; }

  private:
    bool judge();
    void change(int level);

    std::vector<double> costs_;
    int level_;
    double goal_;
    std::vector<double> drawings_, turns_;  // [s] since the last judgement
    double spent_ = 0.0;                    // [s] of them
    int unsettled_ = 0;                     // turns that do not count yet
    double atEase_ = 0.0;                   // [s] for which a level up would have done
    double patience_;                       // [s] of atEase_ before the next level up is tried
    double sinceRise_ = 1e9;                // [s]
    bool wasRegretted_ = false;             // the last rise was taken back soon
};

}  // namespace taut::live
