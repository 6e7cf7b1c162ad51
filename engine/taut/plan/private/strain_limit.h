// Keeps springs of bodies with a strain_limit from being longer than that allows. It only ever stops them:
//
//     |x_b - x_a| <= l_most      or the length when the step began, if that is more
//
// Each of these sets is convex and holds the state in which nothing moves. So a projection onto any of them,
// over-relaxed by less than 2, takes kinetic energy and never adds any, in any order and number (Agmon 1954). Impulses
// of a spring are equal and opposite, so momentum stays. They act along the line of the ends when the step began, which
// keeps angular momentum (rods.h), unless the spring turns too far in a step. Springs take turns until none is too
// long: all of them now and then, in between only springs near their longest length.
#pragma once

#include "taut/plan/constraint.h"

namespace taut::world {

class StrainLimit final : public ConstraintOf<StrainLimit> {
  public:
    static bool isIn(const IslandPlan& plan);  // whether any of its bodies has a limit
    explicit StrainLimit(const IslandPlan& plan);

    std::span<const int> points() const override { return points_; }
    bool projectPositions(const Moment& moment) override;
    bool projectVelocities(const Moment& moment) override;
    void follow(const IslandPlan& plan) override;

  private:
    struct Link {
        int a, b;     // of points_
        double most;  // [m]
    };
    // Calls project(link), which returns whether it changed anything, until none does. Returns whether any did. x: as
    // in Moment.
    template <class Project>
    bool takeTurns(std::span<const dvec3> x, int mostTurns, const Project& project);

    std::vector<int> points_;
    std::vector<Link> links_;
    std::vector<Link> long_;  // of links_, nearly as long as they may be
};

}  // namespace taut::world
