// Springs that yield and break. They are checked after every substep of an island and restored where its tick is
// undone. strength.h says when they yield and break. It knows no tick.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "taut/island/private/dynamics.h"
#include "taut/island/private/strength.h"
#include "taut/plan/island_plan.h"

namespace taut::world {

class Yielding {
  public:
    // To be called when the plan or the strength of its bodies may have changed.
    void watch(const IslandPlan& plan, Dynamics& dynamics);
    bool isOn() const { return isOn_; }        // there are springs that yield or break
    bool hasTorn() const { return hasTorn_; }  // any spring, since keep()

    // After a substep. Returns whether the plan has changed.
    bool giveWay(IslandPlan& plan, Dynamics& dynamics, const ForceList& forces);

    // Keeps the yielded lengths and the broken springs so far.
    void keep();
    // Restores the state at keep().
    void undo(IslandPlan& plan, Dynamics& dynamics, const ForceList& forces);

  private:
    void tear(IslandPlan& plan, Dynamics& dynamics, const ForceList& forces, const std::vector<int>& springs);
    void remember(const IslandPlan& plan, int spring);
    void remember(Body& body);

    struct Spring {
        int number;
        double stiffness, restLength;
        bool isBroken;
    };
    std::unique_ptr<const Strength> strength_;
    bool isOn_ = false, hasTorn_ = false;
    std::vector<int> beyond_;                        // scratch
    std::vector<dvec3> x_;                           // (points) scratch
    std::vector<Spring> before_;                     // changed springs, as they were at keep()
    std::vector<bool> isRemembered_;                 // (springs) whether before_ has it
    std::vector<std::pair<Body*, Damage>> damaged_;  // damaged bodies, with their damage at keep()
};

}  // namespace taut::world
