// The torques of one hinge: friction, damping and a motor about its axis. It holds nothing together.
#pragma once

#include "taut/plan/constraint.h"
#include "taut/plan/mounting.h"
#include "taut/plan/private/tie_ends.h"

namespace taut::world {

class Axle final : public ConstraintOf<Axle> {
  public:
    // The spots of `drive` are set from three places [m] in the scene: two on the axis, and one beside it.
    Axle(Drive drive, const Mounting& at, const std::array<dvec3, 3>& places);

    std::span<const int> points() const override { return ends_.points; }
    std::span<const Place> places() const override { return ends_.places; }
    bool projectPositions(const Moment&) override { return false; }
    bool projectVelocities(const Moment&) override { return false; }
    std::vector<Drive> drives() const override { return holds() ? std::vector{drive_} : std::vector<Drive>(); }

  private:
    TieEnds ends_;
    Drive drive_;
};

}  // namespace taut::world
