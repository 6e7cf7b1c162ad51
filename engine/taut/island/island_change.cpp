// What is changed of an island between two ticks.
#include <algorithm>

#include "taut/island/island.h"
#include "taut/bodies/ties.h"
#include "taut/bodies/joints/constraint.h"

namespace taut::world {

void Island::open(const TickTime& time) {
    if (isOpen_) return;
    if (!frozen_) dynamics_->synchronise(time.start(), contacts_, pressed_);
    isOpen_ = true;
}

void Island::close(const TickTime& time) {
    if (!isOpen_) return;
    if (changes_.any()) {
        dynamics_->take(changes_, forces_);
        watchPlasticity();
        watchLimit(time.start());
    }
    if (choice_.need) {
        if (changes_.any() || haveForcesJumped_)
            choice_.need->raise(dynamics_->stabilityShare(time.start()), inverseMassesOf(plan_));
        const double need = (*choice_.need)(dynamics_->fastestNow());
        if (following_.isExceededBy(need)) following_.shorten(need);
    }
    startWith(time, wantedSubsteps(), false);
    changes_.reset();
    haveForcesJumped_ = false;
    isOpen_ = false;
}

IslandPlan& Island::change(const TickTime& time, Change what) {
    open(time);
    changes_.add(what);
    isChanged_ = true;
    return plan_;
}

void Island::push(const TickTime& time, std::span<const int> points, const dvec3& velocity) {
    open(time);
    const std::vector<dvec3> v = dynamics_->velocities();
    for (int i : points) dynamics_->setVelocity(i, v[static_cast<std::size_t>(i)] + velocity);
}

void Island::stop(const TickTime& time, std::span<const int> points) {
    open(time);
    for (int i : points) dynamics_->setVelocity(i, dvec3(0.0));
}

void Island::lead(const TickTime& time, const std::string& hand, const mechanics::PosePath& path, bool bends) {
    if (frozen_) return;
    for (std::size_t g = 0; g < plan_.grips.size(); ++g) {
        if (plan_.grips[g].ofCollider || plan_.grips[g].holder != hand) continue;
        if (bends) open(time);
        setPath(g, path);
    }
}

void Island::carry(const TickTime& time, const std::string& collider, const mechanics::PosePath& path) {
    if (frozen_) return;
    for (std::size_t g = 0; g < plan_.grips.size(); ++g) {
        if (!plan_.grips[g].ofCollider || plan_.grips[g].holder != collider) continue;
        if (!goesOn(plan_.grips[g].path, path, time.start())) open(time);
        setPath(g, path);
    }
    for (Carrier& carrier : plan_.carriers)
        if (carrier.collider == collider) carrier.path = path;
}

void Island::release(const TickTime& time, const std::string& collider) {
    if (frozen_) return;
    for (std::size_t c = 0; c < plan_.constraints.size(); ++c) {
        std::shared_ptr<Constraint> constraint = plan_.constraints[c]->copy();
        if (constraint->release(collider)) change(time, Change::shape).constraints[c] = std::move(constraint);
    }
}

void Island::setPath(std::size_t grip, const mechanics::PosePath& path) {
    plan_.grips[grip].path = path;
    // Grips that are not what the dynamics know are led when those take them over.
    if (!changes_.has(Change::grips)) dynamics_->leadGrip(grip);
}

void Island::setForces(const TickTime& time, const ForceList& forces) {
    if (frozen_) return;
    const bool jumps = !goesOn(forces_, forces);
    if (jumps) open(time);  // on the forces so far
    haveForcesJumped_ = haveForcesJumped_ || jumps;
    forces_ = forces;
    if (jumps)
        dynamics_->setForces(forces_);
    else
        dynamics_->steer(forces_);
}

// What is changed while it runs may go beyond what a step that stays was chosen for; that is said once. Rest lengths
// have no part in the limit.
void Island::watchLimit(double t) {
    if (choice_.need || changes_ == Changes{}.add(Change::lengths) || !limitWarning_.empty() ||
        !(choice_.step <= choice_.limit))
        return;
    const double limit = stepLimit(plan_, dynamics_->stabilityShare(t));
    if (choice_.step <= limit * (1 + 1e-6)) return;  // single precision computes the share a little differently
    limitWarning_ = plan_.bodies.front()->fullName() + ": since " + inSeconds(t) + " its step of " +
                    inSeconds(choice_.step) + " is over the stability limit, which has fallen to " + inSeconds(limit) +
                    ": it may diverge; a shorter dt, or [hand] in the scene, allows for it";
}

std::vector<dvec3> Island::velocities(const TickTime& time) {
    if (frozen_) return std::vector<dvec3>(plan_.points.size(), dvec3(0.0));
    if (isOpen_) return dynamics_->velocities();
    // Asking changes nothing, the work of the run least of all.
    workElsewhere_ += dynamics_->work();
    std::vector<dvec3> v = dynamics_->velocitiesAt(time.start(), contacts_, pressed_);
    workElsewhere_ -= dynamics_->work();
    return v;
}

}  // namespace taut::world
