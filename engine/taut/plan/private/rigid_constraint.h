// Keeps the points of a solid where a rigid motion has them (mechanics/rigid.h). Held points count as so heavy that the
// solid turns about them.
#pragma once

#include "taut/plan/constraint.h"

namespace taut::world {

class RigidConstraint final : public ConstraintOf<RigidConstraint> {
  public:
    // points of the plan, and their places [m] in one placement.
    RigidConstraint(std::vector<int> points, std::vector<dvec3> rest)
        : points_(std::move(points)), rest_(std::move(rest)) {}

    std::span<const int> points() const override { return points_; }
    bool projectPositions(const Moment& moment) override;
    bool projectVelocities(const Moment& moment) override;
    std::optional<core::RigidMotion> bodyAt(std::span<const dvec3> x, std::span<const dvec3> v,
                                            std::span<const double> inverseMass) const override;

  private:
    std::vector<int> points_;
    std::vector<dvec3> rest_;
    std::vector<double> masses_;  // [kg] scratch
};

}  // namespace taut::world
