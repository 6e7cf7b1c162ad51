#include "taut/island/private/yielding.h"

#include <algorithm>

#include "taut/island/private/cutting.h"

namespace taut::world {

// Beyond the break strain a spring is gone; that strain counts from the length with which it was made. Beyond the yield
// strain its rest length follows, so that the elastic strain stays there. The method goes on; the forces that it keeps
// are those of a moment before.
bool Yielding::giveWay(IslandPlan& plan, Dynamics& dynamics, const ForceList& forces) {
    beyond_.clear();
    dynamics.findBeyond(beyond_);
    if (beyond_.empty()) return false;
    dynamics.positions(x_);
    std::vector<Strength::Break> over;
    std::vector<int> changed;
    for (const int s : beyond_) {
        const double l = lengthOf(plan.springs[s], x_);
        if (const double overload = strength_->overload(s, l); overload > 1) {
            over.push_back({s, overload});
            continue;
        }
        const double next = strength_->yieldedLength(s, l);
        if (next == plan.springs[s].restLength) continue;
        remember(plan, s);
        plan.springs[s].restLength = next;
        changed.push_back(s);
    }
    if (!over.empty()) {
        tear(plan, dynamics, forces, strength_->firstToBreak(std::move(over)));
        return true;
    }
    if (changed.empty()) return false;
    dynamics.changeSprings(changed);
    for (const int s : changed) dynamics.watchLength(s, strength_->limitsOf(s));
    return true;
}

void Yielding::tear(IslandPlan& plan, Dynamics& dynamics, const ForceList& forces, const std::vector<int>& springs) {
    for (const int s : springs) {
        const SpringOrigin& origin = plan.origins[s];
        Body& body = *plan.bodies[origin.body];
        const mechanics::Spring& made = body.model.springs[origin.spring];
        remember(body);
        body.damage.sever(made.a, made.b, 0.5);
    }
    breakSevered(plan, [&](int s) { remember(plan, s); });
    dynamics.take(Changes{}.add(Change::damage), forces);
    watch(plan, dynamics);
    hasTorn_ = true;
}

void Yielding::remember(const IslandPlan& plan, int spring) {
    const auto s = static_cast<std::size_t>(spring);
    isRemembered_.resize(plan.springs.size(), false);
    if (isRemembered_[s]) return;
    isRemembered_[s] = true;
    before_.push_back({spring, plan.springs[s].stiffness, plan.springs[s].restLength, plan.broken[s]});
}

void Yielding::remember(Body& body) {
    if (std::none_of(damaged_.begin(), damaged_.end(), [&](const auto& kept) { return kept.first == &body; }))
        damaged_.emplace_back(&body, body.damage);
}

void Yielding::keep() {
    for (const Spring& was : before_) isRemembered_[was.number] = false;
    before_.clear();
    damaged_.clear();
    hasTorn_ = false;
}

void Yielding::undo(IslandPlan& plan, Dynamics& dynamics, const ForceList& forces) {
    if (before_.empty()) return;
    for (const Spring& was : before_) {
        const auto s = static_cast<std::size_t>(was.number);
        plan.springs[s].stiffness = was.stiffness;
        plan.springs[s].restLength = was.restLength;
        plan.broken[s] = was.isBroken;
    }
    for (auto& [body, damage] : damaged_) body->damage = std::move(damage);
    dynamics.take(Changes{}.add(hasTorn_ ? Change::damage : Change::lengths), forces);
    keep();
    watch(plan, dynamics);
}

void Yielding::watch(const IslandPlan& plan, Dynamics& dynamics) {
    isOn_ = std::any_of(plan.bodies.begin(), plan.bodies.end(),
                        [](const Body* body) { return body->plasticity.yieldStrain || body->plasticity.breakStrain; });
    if (!isOn_) return;
    if (!strength_) strength_ = std::make_unique<const Strength>(plan);
    dynamics.watchLengths(strength_->limits());
}

}  // namespace taut::world
