// The pins of one slider: three places of a body on lines of the other along one axis, two on the axis and one beside
// it, and the forces along the axis. The lines are those of the first body, or of a collider, so that the places stay
// near their body. Its pairs are solved with those of all other bodies (Constraint::Pair::line).
#pragma once

#include "taut/plan/constraint.h"
#include "taut/plan/mounting.h"
#include "taut/plan/private/tie_ends.h"

namespace taut::world {

class Slide final : public ConstraintOf<Slide> {
  public:
    // As Axle; the spots of `drive` are set.
    Slide(Drive drive, const Mounting& at, const std::array<dvec3, 3>& places);

    std::span<const int> points() const override { return ends_.points; }
    std::span<const Place> places() const override { return ends_.places; }
    bool projectPositions(const Moment&) override { return false; }
    bool projectVelocities(const Moment&) override { return false; }
    std::span<const Pair> pairs(double) override {
        return holds() ? std::span<const Pair>(pairs_) : std::span<const Pair>();
    }
    std::vector<Drive> drives() const override {
        return holds() && isDriven_ ? std::vector{drive_} : std::vector<Drive>();
    }

  private:
    TieEnds ends_;
    Drive drive_;
    bool isDriven_ = false;
    std::vector<Pair> pairs_;
};

}  // namespace taut::world
