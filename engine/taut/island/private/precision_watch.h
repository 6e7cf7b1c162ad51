// Whether rounding in single precision keeps points in place, because what a step adds to a coordinate is less than
// half a unit in its last place. It says so once.
#pragma once

#include <string>
#include <vector>

#include "taut/bodies/island_plan.h"
#include "taut/island/private/dynamics.h"

namespace taut::world {

class PrecisionWatch {
  public:
    // Stuck from the start: below what gravity gives in a tick, along whichever axis, or at the speed that it is given.
    // step [s]; limitingSpring: what sets it, in words.
    void foresee(const IslandPlan& plan, const Dynamics& dynamics, double t, double tickSeconds, double step,
                 const std::string& limitingSpring);
    // After every tick.
    void look(const IslandPlan& plan, Dynamics& dynamics, double tickSeconds, double step,
              const std::string& limitingSpring);
    void restart() { ticksToLook_ = 0; }  // steps are others
    const std::string& warning() const { return warning_; }

    void visit(StateBytes& bytes);
    void visitWarning(StateBytes& bytes) { bytes(warning_); }

  private:
    std::string warning_;
    int ticksToLook_ = 0;   // until size and place tell anew whether rounding matters
    double mayLose_ = 0;    // [m] that rounding may keep a point back; 0 where it cannot
    std::vector<dvec3> x_;  // (points) scratch
};

}  // namespace taut::world
