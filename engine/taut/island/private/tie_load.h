// The force through ties of breakable joints, as the mean over a tick. An impact counts by its impulse, with any
// step. It changes nothing.
#pragma once

#include <vector>

#include "taut/island/private/dynamics.h"
#include "taut/plan/island_plan.h"

namespace taut::world {

class TieLoad {
  public:
    // Starts a tick or one of its tries.
    void begin(const IslandPlan& plan);
    bool isOn() const { return !watched_.empty(); }
    // After a step that ended at t [s]: adds the pull of springs, without their dashpots. Constraints sum their own
    // impulses.
    void add(const IslandPlan& plan, const Dynamics& dynamics, double t);
    // (ties) whether each is overloaded in the mean of the tick, which took `seconds` [s].
    std::vector<bool> overloaded(const IslandPlan& plan, const Dynamics& dynamics, double seconds) const;

  private:
    std::vector<std::size_t> watched_;  // ties
    std::vector<dvec3> sum_;            // (watched) [N] over the steps
    int steps_ = 0;
};

}  // namespace taut::world
