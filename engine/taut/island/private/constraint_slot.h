// Projects the constraints of an island, between the method and the contacts. It knows no kind of constraint and no
// tick.
//
// A step goes from x0 to x' = x0 + h v'. Constraints then move x' to x, where they hold, along gradients at x0. They
// change v by (x - x')/h. Under leap-frog, whose v is the velocity of the step, this is SHAKE. Velocities at the time
// of x are projected too, as in RATTLE: the stored velocities, or under leap-frog the predicted ones. Several
// constraints take turns until none moves anything.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "taut/island/private/joined_bodies.h"
#include "taut/island/private/planar.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/ode/method.h"
#include "taut/plan/held_pair.h"

namespace taut::world {

template <class Real>
class ConstraintSlot {
  public:
    using Planes = core::AlignedArray<Real>;
    using Method = ode::Method<Real>;

    // Expects that all three outlive it.
    ConstraintSlot(const IslandPlan& plan, mechanics::MassSpringSystem<Real>& system, ode::State<Real>& state)
        : plan_(plan), system_(system), state_(state), planar_{system.layout().stride} {
        take();
    }

    bool isEmpty() const { return ties_.empty(); }

    // Takes the constraints of the plan again. To be called when the plan has others.
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
            tie.constraint->follow(plan_);
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

    // Lengths of springs of the plan have changed, or some are broken.
    void follow() {
        for (Tie& tie : ties_) tie.constraint->follow(plan_);
    }

    // Pairs that the ties hold at t [s].
    std::span<const HeldPair> heldPairs(double t) {
        held_.clear();
        for (int constraint = 0; constraint < static_cast<int>(ties_.size()); ++constraint) {
            Tie& tie = ties_[constraint];
            const auto endOf = [&](const Spot& end) {
                const auto count = tie.constraint->points().size();
                if (const auto own = static_cast<std::size_t>(end.nearest()); own >= count)
                    return HeldPair::End{-1, &tie.constraint->places()[own - count]};
                return HeldPair::End{end.renumbered([&](int own) { return tie.constraint->points()[own]; })};
            };
            for (const auto& [a, b, number, length, isMost, line] : tie.constraint->pairs(t)) {
                held_.push_back({endOf(a), endOf(b), {constraint, number}, length, isMost});
                if (line) held_.back().line = endOf(*line);
            }
        }
        return held_;
    }

    // [N s] The impulse by which a tie has pulled its first end since forgetImpulses(). Some constraints give it in
    // their own axes.
    void forgetImpulses() { std::fill(impulse_.begin(), impulse_.end(), dvec3(0.0)); }
    const dvec3& impulse(std::size_t constraint, int tie) const { return impulse_[ties_[constraint].first + tie]; }
    // The share of these impulses in ω² [1/s²] at t [s], if they took `seconds` [s].
    double turning(double t, double seconds) {
        load(t, state_.v);
        double most = 0;
        std::vector<dvec3> forces;
        for (Tie& tie : ties_) {
            gather(tie);
            forces.clear();
            for (int own = 0; own < tie.constraint->size(); ++own)
                forces.push_back(impulse_[tie.first + own] / seconds);
            most = std::max(most, tie.constraint->turning(tie.x, tie.w, forces));
        }
        findJoined(x_);
        std::vector<double> held;
        for (const JoinedBodies::Pair& pair : joined_.pairs())
            held.push_back(std::sqrt(glm::dot(impulse_[pair.pull], impulse_[pair.pull])) / seconds);
        return std::max(most, joined_.turning(x_, held));
    }

    // Projects the velocities before a method starts from x and v, both at t [s].
    void start(double t) { projectVelocities(t, state_.v); }
    // Projects velocities at the time t [s] of x.
    void projectVelocities(double t, Planes& velocities) {
        load(t, velocities);
        takeTurns(&Constraint::projectVelocities);
        store(velocities, v_);
    }

    // Projects velocities of places at t [s] that forces have just changed, before split dashpots do. isOfStep: its
    // impulses belong to a step.
    void shareKick(double t, Real* v, bool isOfStep) {
        load(t, state_.v);
        for (std::size_t i = 0; i < points_.size(); ++i) v_[i] = at(v, points_[i]);
        takeTurns(&Constraint::projectVelocities);
        if (isOfStep) addImpulses(1.0);
        for (std::size_t i = 0; i < points_.size(); ++i) set(v, points_[i], v_[i]);
    }

    // Keeps the positions before a step from t [s].
    void remember(double t) {
        load(t, state_.v);
        from_ = x_;
    }
    // Projects positions and velocities after that step, at t [s].
    void project(Method& method, double t, double h) {
        load(t, state_.v);
        reached_ = x_;
        takeTurns(&Constraint::projectPositions);
        addImpulses(1.0 / h);
        drive(h);
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

    // Contact has changed x and v of some points at t [s]; this shares the changes with the points tied to them.
    // Expects that contact changed the stored velocities and those at the time of x alike. Returns whether it had
    // changed anything.
    bool settle(Method& method, double t) {
        load(t, state_.v);
        bool isSame = true;
        for (std::size_t i = 0; i < points_.size(); ++i) isSame = isSame && x_[i] == placed_[i] && v_[i] == stored_[i];
        if (isSame) return false;
        from_ = x_;
        takeTurns(&Constraint::projectPositions, false);
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

    // The largest strain of the ties whose points all count (`only`: points of the plan), at t [s].
    double strain(double t, const std::vector<bool>& only) {
        load(t, state_.v);
        double most = 0;
        std::vector<bool> counts;
        for (Tie& tie : ties_) {
            counts.clear();
            for (const std::size_t n : tie.numbers) counts.push_back(n >= points_.size() || only[points_[n]]);
            gather(tie);
            most = std::max(most, tie.constraint->strain(tie.x, counts));
        }
        return most;
    }

  private:
    static constexpr double settled = 1e-12;  // of places and velocities: joined bodies agree to it

    struct Tie {
        std::shared_ptr<Constraint> constraint;
        std::vector<std::size_t> numbers;  // of points_, followed by places_
        std::vector<double> w;             // [1/kg]
        std::vector<dvec3> from, x, v;
        int first = 0;  // index in pull_ and impulse_
    };

    dvec3 at(const Real* planes, int point) const {
        return {static_cast<double>(planes[planar_.index(point, 0)]),
                static_cast<double>(planes[planar_.index(point, 1)]),
                static_cast<double>(planes[planar_.index(point, 2)])};
    }
    void set(Real* planes, int point, const dvec3& value) const {
        for (int p = 0; p < 3; ++p) planes[planar_.index(point, p)] = static_cast<Real>(value[p]);
    }
    // Loads x at t [s]. Velocities of points come from `velocities`; places move with their colliders.
    void load(double t, const Planes& velocities) {
        time_ = t;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            inverseMass_[i] = static_cast<double>(system_.inverseMasses()[points_[i]]);
            x_[i] = planar_.at(state_.x, points_[i]);
            v_[i] = planar_.at(velocities, points_[i]);
        }
        for (std::size_t k = 0; k < places_.size(); ++k) {
            const mechanics::PosePath::Frame frame = pathOf(plan_, places_[k].collider).at(t);
            const dvec3 arm = frame.arm(places_[k].offset);
            x_[points_.size() + k] = frame.place + arm;
            v_[points_.size() + k] = frame.velocityOf(arm);
        }
    }
    void store(Planes& planes, const std::vector<dvec3>& values) {
        for (std::size_t i = 0; i < points_.size(); ++i) planar_.set(planes, points_[i], values[i]);
    }
    // Keeps the state, to find the change by contact later: x in placed_, stored v in stored_, v at the time of x in
    // reached_.
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
    // Adds the pulls of the last turns, times a factor.
    void addImpulses(double factor) {
        for (std::size_t i = 0; i < pull_.size(); ++i) impulse_[i] += factor * pull_[i];
    }
    // Finds the pull of a constraint with one tie from the first of its points that moves.
    void seePull(const Tie& tie, const std::vector<dvec3>& now, const std::vector<dvec3>& before) {
        for (std::size_t k = 0; k < tie.numbers.size(); ++k) {
            if (!(tie.w[k] > 0)) continue;
            pull_[tie.first] += (now[k] - before[tie.numbers[k]]) / tie.w[k];
            return;
        }
    }
    // The rigid bodies and the pairs that ties hold -> joined_, where points are at these places. Returns the bodies'
    // ties.
    std::vector<Tie*> findJoined(const std::vector<dvec3>& at) {
        joined_.begin(at.size());
        std::vector<Tie*> bodies;
        std::vector<dvec3> own;
        for (Tie& tie : ties_) {
            gather(tie);
            own.clear();
            for (const std::size_t n : tie.numbers) own.push_back(at[n]);
            if (const auto body = tie.constraint->bodyAt(own, tie.v, tie.w)) {
                joined_.addBody(*body, tie.numbers);
                bodies.push_back(&tie);
            }
        }
        if (bodies.empty()) return bodies;
        for (Tie& tie : ties_)
            for (const auto& [a, b, number, length, isMost, line] : tie.constraint->pairs(time_)) {
                const auto numberOf = [&](int end) { return static_cast<int>(tie.numbers[end]); };
                const auto pull = static_cast<std::size_t>(tie.first + number);
                const Spot first = a.renumbered(numberOf), second = b.renumbered(numberOf);
                if (line)
                    joined_.addSliding({first, line->renumbered(numberOf)}, second, pull, at);
                else
                    joined_.addPair({first, second, pull, length, isMost});
            }
        return bodies;
    }
    // Projects the pairs of ties that hold rigid bodies (joined_bodies.h). Returns whether there are any.
    bool joinBodies(bool (Constraint::*projection)(const Constraint::Moment&)) {
        constexpr int mostSolves = 20;
        const bool isOfPlaces = projection == &Constraint::projectPositions;
        const std::vector<Tie*> bodies = findJoined(isOfPlaces ? from_ : x_);
        if (joined_.isEmpty()) return false;
        std::vector<dvec3>& values = isOfPlaces ? x_ : v_;
        const auto makeRigid = [&] {
            for (Tie* tie : bodies) {
                gather(*tie);
                std::vector<dvec3> ignored(1);
                ((*tie->constraint).*projection)({tie->w, tie->from, tie->x, tie->v, ignored, time_});
                for (std::size_t k = 0; k < tie->constraint->points().size(); ++k)
                    values[tie->numbers[k]] = isOfPlaces ? tie->x[k] : tie->v[k];
            }
        };
        // Whether a leash is taut is to be seen of bodies, not of points that have moved by themselves.
        if (joined_.hasLeash()) makeRigid();
        for (int solves = 0; solves < mostSolves; ++solves) {
            const std::vector<dvec3>& at = isOfPlaces ? from_ : x_;
            if (!joined_.solve(at, inverseMass_, values, isOfPlaces, settled)) break;
            for (std::size_t k = 0; k < joined_.pairs().size(); ++k) {
                const JoinedBodies::Pair& pair = joined_.pairs()[k];
                const dvec3& impulse = joined_.impulses()[k];
                pair.a.push(values, inverseMass_, impulse);
                pair.b.push(values, inverseMass_, -impulse);
                // Of a rod as Rods gives it.
                pull_[pair.pull] += pair.length > 0 ? dvec3(joined_.tension(k), 0.0, 0.0) : impulse;
            }
            makeRigid();
        }
        return true;
    }
    // Whether the projection of a tie has just moved a point by more than joined bodies agree to.
    bool hasMoved(const Tie& tie, bool isOfPlaces) const {
        const std::vector<dvec3>&now = isOfPlaces ? tie.x : tie.v, &before = isOfPlaces ? x_ : v_;
        for (std::size_t k = 0; k < tie.constraint->points().size(); ++k) {
            const dvec3 &was = before[tie.numbers[k]], way = now[k] - was;
            if (glm::dot(way, way) > settled * settled * (1.0 + glm::dot(was, was))) return true;
        }
        return false;
    }
    // A drive where its bodies are before a step.
    struct Couple {
        std::array<Spot, 3> a, b;     // numbers of the slot
        bool slides;                  // along the axis: of a, the first spot is where the first of b is
        std::array<dvec3, 2> across;  // [1/m] of a and b, into the turn about the axis; [1] of a slide: along it
        // Of b against a, about the axis: (points) ways [m] or velocities [m/s].
        double turn(std::span<const dvec3> of) const {
            const auto own = [&](const std::array<Spot, 3>& s, const dvec3& by) {
                if (slides) return glm::dot(s[0].of(of), by);
                return glm::dot(s[2].of(of) - 0.5 * (s[0].of(of) + s[1].of(of)), by);
            };
            return own(b, across[1]) - own(a, across[0]);
        }
        void push(std::span<dvec3> values, std::span<const double> inverseMass, double impulse) const {
            const auto own = [&](const std::array<Spot, 3>& s, const dvec3& p) {
                if (slides) return s[0].push(values, inverseMass, p);
                s[2].push(values, inverseMass, p);
                s[0].push(values, inverseMass, -0.5 * p);
                s[1].push(values, inverseMass, -0.5 * p);
            };
            own(a, -impulse * across[0]);
            own(b, impulse * across[1]);
        }
    };
    Couple coupleOf(const Tie& tie, const Constraint::Drive& drive) const {
        const auto numberOf = [&](int end) { return static_cast<int>(tie.numbers[end]); };
        Couple couple{drive.a, drive.b, drive.slides, {}};
        for (auto* spots : {&couple.a, &couple.b})
            for (Spot& spot : *spots) spot = spot.renumbered(numberOf);
        const auto acrossOf = [&](const std::array<Spot, 3>& s) {
            const dvec3 low = s[0].of(from_), high = s[1].of(from_), arm = s[2].of(from_) - 0.5 * (low + high);
            return glm::cross(glm::normalize(high - low), arm) / glm::dot(arm, arm);
        };
        if (drive.slides) {
            couple.a[0] = JoinedBodies::footOf({couple.a[0], couple.a[1]}, couple.b[0], from_);
            couple.across.fill(glm::normalize(couple.a[1].of(from_) - drive.a[0].renumbered(numberOf).of(from_)));
        } else {
            couple.across = {acrossOf(couple.a), acrossOf(couple.b)};
        }
        return couple;
    }
    // Torques of hinges and forces of sliders during a step of h [s] change its result. The inertia of a joint with its
    // load is measured by an impulse of 1 N m s, or 1 N s. Expects in from_ the places on colliders at the start of the
    // step.
    void drive(double h) {
        for (const Tie& tie : ties_)
            for (const Constraint::Drive& own : tie.constraint->drives()) {
                const Couple couple = coupleOf(tie, own);
                std::vector<dvec3> way(x_.size());
                for (std::size_t i = 0; i < x_.size(); ++i) way[i] = (x_[i] - from_[i]) / h;
                const double rate = couple.turn(way), wanted = own.most > 0 ? own.speed - rate : -rate;
                if (wanted == 0.0) continue;
                const double unit = wanted > 0 ? 1.0 : -1.0;  // [N m s]
                const std::vector<dvec3> before = v_;
                v_.assign(v_.size(), dvec3(0.0));
                couple.push(v_, inverseMass_, unit);
                takeTurns(&Constraint::projectVelocities);
                const double ease = couple.turn(v_) / unit;  // [1/(kg m²)]
                v_ = before;
                if (!(ease > 0)) continue;
                double impulse = -own.damping * h * rate / (1.0 + own.damping * h * ease);
                const auto seek = [&](double speed, double most) {
                    impulse += std::clamp((speed - rate) / ease - impulse, -most * h, most * h);
                };
                if (own.friction > 0) seek(0.0, own.friction);
                if (own.most > 0) seek(own.speed, own.most);
                couple.push(x_, inverseMass_, impulse * h);
                takeTurns(&Constraint::projectPositions);
                addImpulses(1.0 / h);
            }
    }
    // Joined bodies are solved together first; turns that move their points by less than that leaves end. isOfStep: as
    // in Moment.
    void takeTurns(bool (Constraint::*projection)(const Constraint::Moment&), bool isOfStep = true) {
        constexpr int mostRounds = 50;
        std::fill(pull_.begin(), pull_.end(), dvec3(0.0));
        const bool isJoined = ties_.size() > 1 && joinBodies(projection);
        std::vector<dvec3> ignored(1);
        const bool isOfPlaces = projection == &Constraint::projectPositions;
        for (int round = 0; round < mostRounds; ++round) {
            bool moves = false;
            for (Tie& tie : ties_) {
                gather(tie);
                const auto size = static_cast<std::size_t>(tie.constraint->size());
                const bool isOne = size == 1;
                const std::span<dvec3> pull = isOne ? std::span(ignored) : std::span(pull_).subspan(tie.first, size);
                if (!((*tie.constraint).*projection)({tie.w, tie.from, tie.x, tie.v, pull, time_, isOfStep})) continue;
                moves = moves || !isJoined || hasMoved(tie, isOfPlaces);
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
    std::vector<int> points_;                // all points of any tie, ascending
    std::vector<Constraint::Place> places_;  // all places of any tie
    double time_ = 0;                        // [s] of the loaded values
    // (points, then places)
    std::vector<double> inverseMass_;
    std::vector<dvec3> from_, x_, v_;
    std::vector<dvec3> reached_;  // x before its projection; later the velocities at the time of x, as projected
    std::vector<dvec3> placed_, stored_;
    std::vector<dvec3> pull_, impulse_;  // (ties of all constraints)
    JoinedBodies joined_;                // of the last turns
    std::vector<HeldPair> held_;         // as of heldPairs()
};

}  // namespace taut::world
