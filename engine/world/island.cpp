#include "taut/world/island.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "taut/world/divergence.h"
#include "taut/world/island_of.h"
#include "taut/world/motion.h"

namespace taut::world {

template <class Real>
IslandOf<Real>::IslandOf(IslandPlan plan, const ForceList& forces, Envelope envelope, double ticksPerSecond,
                         double t)
    : plan_(std::move(plan)), forces_(forces), system_(systemOf(plan_)), state_(system_.layout()) {
    addGenerators();
    for (std::size_t i = 0; i < plan_.positions.size(); ++i)
        for (int p = 0; p < 3; ++p) {
            state_.x[index(static_cast<int>(i), p)] = static_cast<Real>(plan_.positions[i][p]);
            state_.v[index(static_cast<int>(i), p)] = static_cast<Real>(plan_.velocities[i][p]);
        }
    chooseStepFor(envelope, 1.0 / ticksPerSecond, t);
    makeMethod();
    method_->start(system_, t, choice_.step, state_);
    before_ = core::AlignedArray<Real>(system_.layout().size());
    velocity_ = before_;
    good_ = state_;
}

template <class Real>
void IslandOf<Real>::makeMethod() {
    const SolverSpec& solver = plan_.solver;
    method_ = methodsOf(solver).make<Real>(solver.integrator,
                                           {solver.newtonSteps, solver.cgTolerance, solver.cgIterations});
}

template <class Real>
std::optional<Fault> IslandOf<Real>::tick(const TickTime& time, std::span<const ColliderMotion> moving) {
    if (frozen_) return std::nullopt;
    TAUT_EXPECTS(!isOpen_);
    copyState(state_, good_);
    hasMoved_ = true;
    const bool mayFreeze = plan_.solver.onDivergence == OnDivergence::freeze;
    const bool collides = colliders_.size() > 0 && std::any_of(plan_.bodies.begin(), plan_.bodies.end(),
                                                               [](const Body* b) { return b->spec->collide; });
    for (int s = 0; s < choice_.substeps; ++s) {
        if (mayFreeze) copyState(state_, good_);
        if (collides) std::copy(state_.x.begin(), state_.x.end(), before_.begin());
        method_->step(system_, time.at(s, choice_.substeps), choice_.step, state_);
        if (!isBounded()) return giveUp(time.at(s + 1, choice_.substeps));
        if (collides) collide(moving, s);
        if (!contacts_.empty() && !isBounded()) return giveUp(time.at(s + 1, choice_.substeps));
        if (!mayFreeze) continue;
        if (const auto fault = overstrained(time.at(s + 1, choice_.substeps))) return fault;
    }
    watchVolumes(time.at(choice_.substeps, choice_.substeps));
    return std::nullopt;
}

template <class Real>
void IslandOf<Real>::freeze(const Fault& fault, const TickTime& time) {
    copyState(good_, state_);
    contacts_.clear();
    FrozenIsland frozen;
    frozen.name = plan_.bodies.front()->fullName();
    for (const Body* body : plan_.bodies) frozen.bodies.push_back(body->fullName());
    frozen.time = fault.time - choice_.step;
    frozen.divergence = diagnose(fault, time);
    frozen_ = std::move(frozen);
}

template <class Real>
void IslandOf<Real>::addToHash(const Body& body, core::Hash& hash) const {
    for (const core::AlignedArray<Real>* array : {&state_.x, &state_.v})
        for (int i : body.pointOf)
            for (int p = 0; p < 3; ++p) hash.add((*array)[index(i, p)]);
}

template <class Real>
void IslandOf<Real>::addPointToHash(int point, core::Hash& hash) const {
    for (const core::AlignedArray<Real>* array : {&state_.x, &state_.v})
        for (int p = 0; p < 3; ++p) hash.add((*array)[index(point, p)]);
}

template <class Real>
void IslandOf<Real>::copyState(const ode::State<Real>& from, ode::State<Real>& to) {
    std::copy(from.x.begin(), from.x.end(), to.x.begin());
    std::copy(from.v.begin(), from.v.end(), to.v.begin());
    for (std::size_t i = 0; i < from.memory.size(); ++i)
        std::copy(from.memory[i].begin(), from.memory[i].end(), to.memory[i].begin());
}

// Every velocity is a number below the limit; written so that NaN fails.
template <class Real>
bool IslandOf<Real>::isBounded() const {
    const Real limit = static_cast<Real>(mechanics::speedLimit);
    const Real* v = state_.v.data();
    const int size = static_cast<int>(state_.v.size());
    int bad = 0;
    for (int i = 0; i < size; ++i) bad |= static_cast<int>(!(v[i] < limit)) | static_cast<int>(!(v[i] > -limit));
    return bad == 0;
}

template <class Real>
Fault IslandOf<Real>::giveUp(double t) const {
    Fault fault;
    fault.time = t;
    double fastest = -1;
    for (int i = 0; i < state_.layout.count; ++i) {
        const dvec3 v = at(state_.v, i);
        const double speed = std::sqrt(glm::dot(v, v));
        if (!std::isfinite(speed)) {
            fault.point = i;
            fault.isNumber = false;
            break;
        }
        if (speed > fastest) {
            fastest = speed;
            fault.point = i;
        }
    }
    return fault;
}

template <class Real>
double IslandOf<Real>::lengthOf(const mechanics::Spring& spring) const {
    const dvec3 d = at(state_.x, spring.b) - at(state_.x, spring.a);
    return std::sqrt(glm::dot(d, d));
}

// The spring furthest from its rest length, if that is further than freezing allows. Springs of bending span two
// cells and tell nothing that the others do not.
template <class Real>
std::optional<Fault> IslandOf<Real>::overstrained(double t) const {
    Fault fault;
    for (std::size_t i = 0; i < plan_.springs.size(); ++i) {
        const mechanics::Spring& s = plan_.springs[i];
        if (s.kind == mechanics::SpringKind::bend || !(s.restLength > 0) || plan_.broken[i]) continue;
        const double strain = std::abs(lengthOf(s) - s.restLength) / s.restLength;
        if (strain <= std::max(fault.strain, plan_.solver.freezeStrain)) continue;
        fault.strain = strain;
        fault.point = plan_.points[static_cast<std::size_t>(s.a)].held ? s.b : s.a;
    }
    if (fault.point < 0) return std::nullopt;
    fault.time = t;
    return fault;
}

template <class Real>
void IslandOf<Real>::collide(std::span<const ColliderMotion> moving, int substep) {
    contacts_.clear();
    const double n = choice_.substeps;
    for (const ColliderMotion& m : moving)
        colliders_.move(m.collider, between(m.from, m.to, substep / n), between(m.from, m.to, (substep + 1) / n));
    for (const Body* body : plan_.bodies) {
        if (!body->spec->collide || body->lastPoint == body->firstPoint) continue;
        collision::MovingPoints<Real> points;
        points.first = body->firstPoint;
        points.last = body->lastPoint;
        points.stride = state_.layout.stride;
        points.xBefore = before_.data();
        points.x = state_.x.data();
        points.v = state_.v.data();
        points.inverseMass = system_.inverseMasses();
        points.thickness = body->spec->thickness;
        points.friction = body->spec->friction;
        colliders_.resolve(points, choice_.step, contacts_);
    }
    touched_.clear();
    for (const collision::Contact& contact : contacts_) touched_.push_back(contact.point);
    if (!touched_.empty()) method_->touch(state_, touched_);
}

// Beyond the working stretch the step may not hold, and a collapsed cell may not come back: each said once.
template <class Real>
void IslandOf<Real>::watchVolumes(double t) {
    if (volumes_.empty() || (!stretchWarning_.empty() && !collapseWarning_.empty())) return;
    char text[200];
    for (const VolumeOf& entry : volumes_) {
        const mechanics::VolumeReport report = entry.volume->inspect(motion(t));
        const std::string name = plan_.bodies.front()->fullName();
        if (report.overstretched > 0 && stretchWarning_.empty()) {
            std::snprintf(text, sizeof text,
                          ": stretched beyond working_stretch at %.3f s; raise it if the block diverges", t);
            stretchWarning_ = name + text;
        }
        if (report.collapsed > 0 && collapseWarning_.empty()) {
            std::snprintf(text, sizeof text,
                          ": squashed to %.2g of its volume in a cell at %.3f s (%d cells below a tenth, %d turned "
                          "inside out); raise bulk_Pa or young_Pa",
                          report.smallestRatio, t, report.collapsed, report.inverted);
            collapseWarning_ = name + text;
        }
    }
}

template class IslandOf<float>;
template class IslandOf<double>;

std::unique_ptr<Island> makeIsland(IslandPlan plan, const ForceList& forces, Envelope envelope,
                                   double ticksPerSecond, double t) {
    if (plan.solver.precision == Precision::single_)
        return std::make_unique<IslandOf<float>>(std::move(plan), forces, std::move(envelope), ticksPerSecond, t);
    return std::make_unique<IslandOf<double>>(std::move(plan), forces, std::move(envelope), ticksPerSecond, t);
}

}  // namespace taut::world
