// The force through ties of joints that may break, as the mean over a tick: an impact counts by its impulse, whatever
// the step. It changes nothing.
#pragma once

#include <vector>

#include "taut/bodies/island_plan.h"
#include "taut/island/private/dynamics.h"

namespace taut::world {

class TieLoad {
  public:
    // A tick begins, or one of its tries.
    void begin(const IslandPlan& plan);
    bool isOn() const { return !watched_.empty(); }
    // After a step that ended at t [s]: what springs pull with, without their dashpots. Constraints count for
    // themselves.
    void add(const IslandPlan& plan, const Dynamics& dynamics, double t);
    // (ties) of the tick, which took so many seconds.
    std::vector<bool> overloaded(const IslandPlan& plan, const Dynamics& dynamics, double seconds) const;

  private:
    std::vector<std::size_t> watched_;  // ties
    std::vector<dvec3> sum_;            // (watched) [N] of the steps
    int steps_ = 0;
};

}  // namespace taut::world
