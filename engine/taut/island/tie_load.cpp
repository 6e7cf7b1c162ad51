#include "taut/island/private/tie_load.h"

#include <algorithm>
#include <cmath>

#include "taut/plan/constraint.h"
#include "taut/plan/private/tie_ends.h"

namespace taut::world {
namespace {

// [N] of a spring on its first end, along its axis. The axis turns, so the sum counts along it.
double pullOf(const mechanics::Spring& spring, const Dynamics& dynamics) {
    const dvec3 d = dynamics.position(spring.b) - dynamics.position(spring.a);
    return spring.stiffness * (std::sqrt(glm::dot(d, d)) - spring.restLength);
}

// [N] that draws a point to its place on a collider at t [s].
dvec3 pullOf(const Grip& grip, const Dynamics& dynamics, double t) {
    const mechanics::PosePath::Frame frame = grip.path.at(t);
    dvec3 sum(0.0);
    for (std::size_t i = 0; i < grip.points.size(); ++i) {
        const dvec3 way = frame.place + frame.arm(grip.offsets[i]) - dynamics.position(grip.points[i]);
        const double length = grip.lengths.empty() ? 0.0 : grip.lengths[i];
        sum += grip.stiffness[i] * (length > 0 ? (1.0 - length / std::sqrt(glm::dot(way, way))) * way : way);
    }
    return sum;
}

// [N] of a spring between places at t [s], as of one between points.
double pullOf(const Constraint& constraint, int tie, const IslandPlan& plan, const Dynamics& dynamics, double t) {
    const std::vector<Constraint::Pull> pulls = constraint.pulls();
    if (pulls.empty()) return 0.0;
    const std::span<const int> points = constraint.points();
    dvec3 d(0.0);
    const Constraint::Pull& pull = pulls[tie];
    for (const auto& [number, weight] : TieEnds::difference(pull.a, pull.b)) {
        const auto own = static_cast<std::size_t>(number);
        if (own < points.size()) {
            d += weight * dynamics.position(points[own]);
            continue;
        }
        const Constraint::Place& place = constraint.places()[own - points.size()];
        const mechanics::PosePath::Frame frame = pathOf(plan, place.collider).at(t);
        d += weight * (frame.place + frame.arm(place.offset));
    }
    return pull.stiffness * (std::sqrt(glm::dot(d, d)) - pull.length);
}

}  // namespace

void TieLoad::begin(const IslandPlan& plan) {
    watched_.clear();
    steps_ = 0;
    for (std::size_t t = 0; t < plan.ties.size(); ++t)
        if (plan.ties[t].breakForce < HUGE_VAL && holds(plan, plan.ties[t])) watched_.push_back(t);
    sum_.assign(watched_.size(), dvec3(0.0));
}

void TieLoad::add(const IslandPlan& plan, const Dynamics& dynamics, double t) {
    ++steps_;
    for (std::size_t w = 0; w < watched_.size(); ++w) {
        const JointTie& tie = plan.ties[watched_[w]];
        for (const int s : tie.springs) sum_[w].x += pullOf(plan.springs[s], dynamics);
        for (const JointTie::Part& part : tie.parts)
            sum_[w].x += pullOf(*plan.constraints[part.constraint], part.tie, plan, dynamics, t);
        if (!tie.isGrip) continue;
        for (const Grip& grip : plan.grips)
            if (grip.tie == static_cast<int>(watched_[w])) sum_[w] += pullOf(grip, dynamics, t);
    }
}

std::vector<bool> TieLoad::overloaded(const IslandPlan& plan, const Dynamics& dynamics, double seconds) const {
    std::vector<bool> isOver(plan.ties.size(), false);
    for (std::size_t w = 0; w < watched_.size(); ++w) {
        const JointTie& tie = plan.ties[watched_[w]];
        dvec3 force = sum_[w] / static_cast<double>(std::max(steps_, 1));
        for (const JointTie::Part& part : tie.parts) force += dynamics.impulse(part) / seconds;
        isOver[watched_[w]] = std::sqrt(glm::dot(force, force)) > tie.breakForce;
    }
    return isOver;
}

}  // namespace taut::world
