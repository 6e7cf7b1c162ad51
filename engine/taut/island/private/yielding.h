// Springs that yield and break, looked at after every substep of an island, and held again where its tick is undone.
// strength.h says when they do. It knows no tick.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "taut/bodies/island_plan.h"
#include "taut/island/private/dynamics.h"
#include "taut/island/private/strength.h"

namespace taut::world {

class Yielding {
  public:
    // The plan or what its bodies bear may be another.
    void watch(const IslandPlan& plan, Dynamics& dynamics);
    bool isOn() const { return isOn_; }        // there are springs that yield or break
    bool hasTorn() const { return hasTorn_; }  // any, since keep()

    // After a substep. Returns whether the plan has changed.
    bool giveWay(IslandPlan& plan, Dynamics& dynamics, const ForceList& forces);

    // What has given way so far stays so.
    void keep();
    // What has given way and torn since then holds again.
    void undo(IslandPlan& plan, Dynamics& dynamics, const ForceList& forces);

  private:
    // Appends the springs that have changed.
    void tear(IslandPlan& plan, Dynamics& dynamics, const ForceList& forces, const std::vector<int>& springs,
              std::vector<int>& changed);
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
    std::vector<Spring> before_;                     // of what has changed, what it was at keep()
    std::vector<bool> isRemembered_;                 // (springs) there
    std::vector<std::pair<Body*, Damage>> damaged_;  // likewise
};

}  // namespace taut::world
