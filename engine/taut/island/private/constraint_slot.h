// The constraints of an island, between its method and its contacts: what projects them, and into which arrays. It
// knows no kind of constraint and no tick.
//
// After a step from x0 to x' = x0 + h v', x is brought to where they hold, along gradients at x0, and v changes by
// (x - x')/h: under leap-frog, whose v is that of the step, this is SHAKE. Velocities at the time of x are projected
// too, as RATTLE does: those of methods that store them, and what leap-frog predicts. Several constraints take turns
// until none moves anything.
#pragma once

#include <algorithm>
#include <vector>

#include "taut/mechanics/mass_spring_system.h"
#include "taut/ode/method.h"
#include "taut/bodies/island_plan.h"
#include "taut/bodies/joints/constraint.h"
#include "taut/island/private/planar.h"

namespace taut::world {

template <class Real>
class ConstraintSlot {
  public:
    using Planes = core::AlignedArray<Real>;
    using Method = ode::Method<Real>;

    // Expects that all three stay.
    ConstraintSlot(const IslandPlan& plan, mechanics::MassSpringSystem<Real>& system, ode::State<Real>& state)
        : plan_(plan), system_(system), state_(state), planar_{system.layout().stride} {
        take();
    }

    bool isEmpty() const { return ties_.empty(); }

    // The plan has others.
    void take() {
        ties_.clear();
        points_.clear();
        places_.clear();
        pull_.clear();
        for (const auto& constraint : plan_.constraints) {
            const std::span<const int> own = constraint->points();
            points_.insert(points_.end(), own.begin(), own.end());
        }
        std::sort(points_.begin(), points_.end());
        points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
        for (const auto& constraint : plan_.constraints) {
            Tie& tie = ties_.emplace_back();
            tie.constraint = constraint->copy();
            for (const int point : tie.constraint->points())
                tie.numbers.push_back(static_cast<std::size_t>(std::lower_bound(points_.begin(), points_.end(), point) -
                                                               points_.begin()));
            for (const Constraint::Place& place : tie.constraint->places()) {
                tie.numbers.push_back(points_.size() + places_.size());
                places_.push_back(place);
            }
            tie.first = static_cast<int>(pull_.size());
            pull_.resize(pull_.size() + static_cast<std::size_t>(tie.constraint->size()));
            tie.w.resize(tie.numbers.size());
            tie.from = tie.x = tie.v = std::vector<dvec3>(tie.numbers.size());
        }
        inverseMass_.assign(points_.size() + places_.size(), 0.0);
        from_ = x_ = v_ = reached_ = placed_ = stored_ = std::vector<dvec3>(inverseMass_.size());
        impulse_.assign(pull_.size(), dvec3(0.0));
    }

    // [N s] that a tie of a constraint has pulled its first end with since then; of some in axes of its own.
    void forgetImpulses() { std::fill(impulse_.begin(), impulse_.end(), dvec3(0.0)); }
    const dvec3& impulse(std::size_t constraint, int tie) const {
        return impulse_[static_cast<std::size_t>(ties_[constraint].first + tie)];
    }
    // What that adds to ω² [1/s²] where it was pulled for so long [s], at t [s].
    double turning(double t, double seconds) {
        load(t, state_.v);
        double most = 0;
        std::vector<dvec3> forces;
        for (Tie& tie : ties_) {
            gather(tie);
            forces.clear();
            for (int own = 0; own < tie.constraint->size(); ++own)
                forces.push_back(impulse_[static_cast<std::size_t>(tie.first + own)] / seconds);
            most = std::max(most, tie.constraint->turning(tie.x, tie.w, forces));
        }
        return most;
    }

    // Before a method starts from x and v, both at t [s].
    void start(double t) { projectVelocities(t, state_.v); }
    // Velocities at the time t [s] of x.
    void projectVelocities(double t, Planes& velocities) {
        load(t, velocities);
        takeTurns(&Constraint::projectVelocities);
        store(velocities, v_);
    }

    // Before a step from t [s].
    void remember(double t) {
        load(t, state_.v);
        from_ = x_;
    }
    // After it, at t [s].
    void project(Method& method, double t, double h) {
        load(t, state_.v);
        reached_ = x_;
        takeTurns(&Constraint::projectPositions);
        addImpulses(1.0 / h);
        Real* predicted = method.predicted(state_);
        const bool isHalfStep = predicted != state_.v.data();
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const dvec3 change = (x_[i] - reached_[i]) / h;
            stored_[i] = v_[i] + change;
            // w' = 1.5 v⁺ - 0.5 v⁻
            v_[i] = isHalfStep ? at(predicted, points_[i]) + 1.5 * change : stored_[i];
        }
        takeTurns(&Constraint::projectVelocities);
        if (!isHalfStep) addImpulses(1.0);
        store(state_.x, x_);
        store(state_.v, isHalfStep ? stored_ : v_);
        if (isHalfStep)
            for (std::size_t i = 0; i < points_.size(); ++i) set(predicted, points_[i], v_[i]);
        else
            method.touch(state_, points_);
        keep();
    }

    // After contact, at t [s]: what it changed of x and v is shared with what they tie. Contact has left velocities
    // that are stored and those at the time of x with one change. Returns whether it had changed anything.
    bool settle(Method& method, double t) {
        load(t, state_.v);
        bool isSame = true;
        for (std::size_t i = 0; i < points_.size(); ++i) isSame = isSame && x_[i] == placed_[i] && v_[i] == stored_[i];
        if (isSame) return false;
        from_ = x_;
        takeTurns(&Constraint::projectPositions);
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const dvec3 change = v_[i] - stored_[i];
            stored_[i] = v_[i];
            v_[i] = reached_[i] + change;
            reached_[i] = v_[i];
        }
        takeTurns(&Constraint::projectVelocities);
        addImpulses(1.0);
        store(state_.x, x_);
        Real* predicted = method.predicted(state_);
        const bool isHalfStep = predicted != state_.v.data();
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const dvec3 change = v_[i] - reached_[i];
            planar_.set(state_.v, points_[i], stored_[i] + change);
            if (isHalfStep) set(predicted, points_[i], at(predicted, points_[i]) + change);
        }
        if (!isHalfStep) method.touch(state_, points_);
        keep();
        return true;
    }

    // The largest of ties whose points all count (points of the plan), at t [s].
    double strain(double t, const std::vector<bool>& only) {
        load(t, state_.v);
        double most = 0;
        std::vector<bool> counts;
        for (Tie& tie : ties_) {
            counts.clear();
            for (const std::size_t n : tie.numbers)
                counts.push_back(n >= points_.size() || only[static_cast<std::size_t>(points_[n])]);
            gather(tie);
            most = std::max(most, tie.constraint->strain(tie.x, counts));
        }
        return most;
    }

  private:
    struct Tie {
        std::shared_ptr<Constraint> constraint;
        std::vector<std::size_t> numbers;  // of points_, then of places_ after them
        std::vector<double> w;             // [1/kg]
        std::vector<dvec3> from, x, v;
        int first = 0;  // of pull_ and impulse_
    };

    dvec3 at(const Real* planes, int point) const {
        return {static_cast<double>(planes[planar_.index(point, 0)]),
                static_cast<double>(planes[planar_.index(point, 1)]),
                static_cast<double>(planes[planar_.index(point, 2)])};
    }
    void set(Real* planes, int point, const dvec3& value) const {
        for (int p = 0; p < 3; ++p) planes[planar_.index(point, p)] = static_cast<Real>(value[p]);
    }
    // x at t [s] and these velocities of points; of places both.
    void load(double t, const Planes& velocities) {
        for (std::size_t i = 0; i < points_.size(); ++i) {
            inverseMass_[i] = static_cast<double>(system_.inverseMasses()[points_[i]]);
            x_[i] = planar_.at(state_.x, points_[i]);
            v_[i] = planar_.at(velocities, points_[i]);
        }
        for (std::size_t k = 0; k < places_.size(); ++k) {
            const mechanics::PosePath::Frame frame = pathOf(places_[k].collider).at(t);
            const dvec3 arm = frame.arm(places_[k].offset);
            x_[points_.size() + k] = frame.place + arm;
            v_[points_.size() + k] = frame.velocityOf(arm);
        }
    }
    const mechanics::PosePath& pathOf(const std::string& collider) const {
        return std::find_if(
                   plan_.carriers.begin(), plan_.carriers.end(),
                   [&](const Carrier& carrier) { return carrier.collider == collider; })
            ->path;
    }
    void store(Planes& planes, const std::vector<dvec3>& values) {
        for (std::size_t i = 0; i < points_.size(); ++i) planar_.set(planes, points_[i], values[i]);
    }
    // What stands in the state, to see what contact changes of it: placed_ and stored_, and v_ in reached_.
    void keep() {
        reached_ = v_;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            placed_[i] = planar_.at(state_.x, points_[i]);
            stored_[i] = planar_.at(state_.v, points_[i]);
        }
    }

    void gather(Tie& tie) const {
        for (std::size_t k = 0; k < tie.numbers.size(); ++k) {
            const std::size_t n = tie.numbers[k];
            tie.w[k] = inverseMass_[n];
            tie.from[k] = from_[n];
            tie.x[k] = x_[n];
            tie.v[k] = v_[n];
        }
    }
    // What the last turns have pulled with, times a factor.
    void addImpulses(double factor) {
        for (std::size_t i = 0; i < pull_.size(); ++i) impulse_[i] += factor * pull_[i];
    }
    // Of one tie alone: by what its first point that moves has moved, or its second is moved the other way.
    void seePull(const Tie& tie, const std::vector<dvec3>& now, const std::vector<dvec3>& before) {
        for (std::size_t k = 0; k < tie.numbers.size(); ++k) {
            if (!(tie.w[k] > 0)) continue;
            pull_[static_cast<std::size_t>(tie.first)] += (now[k] - before[tie.numbers[k]]) / tie.w[k];
            return;
        }
    }
    void takeTurns(bool (Constraint::*projection)(const Constraint::Moment&)) {
        constexpr int mostRounds = 50;
        std::fill(pull_.begin(), pull_.end(), dvec3(0.0));
        std::vector<dvec3> ignored(1);
        const bool isOfPlaces = projection == &Constraint::projectPositions;
        for (int round = 0; round < mostRounds; ++round) {
            bool moves = false;
            for (Tie& tie : ties_) {
                gather(tie);
                const auto size = static_cast<std::size_t>(tie.constraint->size());
                const bool isOne = size == 1;
                const std::span<dvec3> pull =
                    isOne ? std::span(ignored) : std::span(pull_).subspan(static_cast<std::size_t>(tie.first), size);
                if (!((*tie.constraint).*projection)({tie.w, tie.from, tie.x, tie.v, pull})) continue;
                moves = true;
                if (isOne) isOfPlaces ? seePull(tie, tie.x, x_) : seePull(tie, tie.v, v_);
                for (std::size_t k = 0; k < tie.constraint->points().size(); ++k) {
                    x_[tie.numbers[k]] = tie.x[k];
                    v_[tie.numbers[k]] = tie.v[k];
                }
            }
            if (!moves || ties_.size() == 1) return;
        }
    }

    const IslandPlan& plan_;
    mechanics::MassSpringSystem<Real>& system_;
    ode::State<Real>& state_;
    Planar<Real> planar_;
    std::vector<Tie> ties_;
    std::vector<int> points_;                // that any ties, ascending
    std::vector<Constraint::Place> places_;  // likewise
    // (points, then places)
    std::vector<double> inverseMass_;
    std::vector<dvec3> from_, x_, v_;
    std::vector<dvec3> reached_;  // x before it is projected; then velocities at its time, as they were left
    std::vector<dvec3> placed_, stored_;
    std::vector<dvec3> pull_, impulse_;  // (ties of all constraints)
};

}  // namespace taut::world
