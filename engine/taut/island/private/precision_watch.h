// Warns once if rounding in single precision keeps points in place. That happens when a step adds less to a coordinate
// than half a unit in its last place.
#pragma once

#include <string>
#include <vector>

#include "taut/island/private/dynamics.h"
#include "taut/plan/island_plan.h"

namespace taut::world {

class PrecisionWatch {
  public:
    // Looks for points that are stuck from the start: gravity over one tick, or the given velocity, is too slow along
    // an axis. step [s]; limitingSpring: its cause, in words.
    void foresee(const IslandPlan& plan, const Dynamics& dynamics, double t, double tickSeconds, double step,
                 const std::string& limitingSpring);
    // After every tick.
    void look(const IslandPlan& plan, Dynamics& dynamics, double tickSeconds, double step,
              const std::string& limitingSpring);
    void restart() { ticksToLook_ = 0; }  // to be called when steps change
    const std::string& warning() const { return warning_; }

    void visit(StateBytes& bytes);
    void visitWarning(StateBytes& bytes) { bytes(warning_); }

  private:
    std::string warning_;
    int ticksToLook_ = 0;   // ticks until size and place decide again whether rounding matters
    double mayLose_ = 0;    // [m] by which rounding may keep a point back unnoticed; 0 where it cannot do so
    std::vector<dvec3> x_;  // (points) scratch
};

}  // namespace taut::world
