// Springs that give way and break, looked at after every substep.
#include <algorithm>

#include "taut/island/island.h"

namespace taut::world {

// Beyond the break strain, against the length that it was made with, a spring is gone; beyond the yield strain its
// rest length follows, so that the elastic strain stays at it. The method goes on: what it keeps of forces is those of
// a moment before.
void Island::giveWay() {
    beyond_.clear();
    dynamics_->findBeyond(beyond_);
    if (beyond_.empty()) return;
    dynamics_->positions(x_);
    std::vector<Strength::Break> over;
    std::vector<int> changed;
    for (const int s : beyond_) {
        const double l = lengthOf(plan_.springs[static_cast<std::size_t>(s)], x_);
        if (const double overload = strength_->overload(s, l); overload > 1) {
            over.push_back({s, overload});
            continue;
        }
        const double next = strength_->yieldedLength(s, l);
        if (next == plan_.springs[static_cast<std::size_t>(s)].restLength) continue;
        remember(s);
        plan_.springs[static_cast<std::size_t>(s)].restLength = next;
        changed.push_back(s);
    }
    if (!over.empty()) tear(strength_->firstToBreak(std::move(over)), changed);
    if (changed.empty()) return;
    isChanged_ = true;
    dynamics_->changeSprings(changed);
    for (const int s : changed) dynamics_->watchLength(s, strength_->limitsOf(s));
}

// Appends what has changed.
void Island::tear(const std::vector<int>& springs, std::vector<int>& changed) {
    bool isSurfaceLess = false;
    std::vector<std::pair<int, int>> ends;
    for (const int s : springs) {
        const SpringOrigin& origin = plan_.origins[static_cast<std::size_t>(s)];
        Body& body = *plan_.bodies[static_cast<std::size_t>(origin.body)];
        const mechanics::Spring& made = body.model.springs[static_cast<std::size_t>(origin.spring)];
        remember(body);
        body.damage.sever(made.a, made.b, 0.5);
    }
    for (std::size_t number = 0; number < plan_.bodies.size(); ++number) {
        Body& body = *plan_.bodies[number];
        const Damage::Assessed assessed = body.damage.assess(body.model);
        isSurfaceLess = isSurfaceLess || assessed.isSurfaceLess;
        for (const auto& [a, b] : assessed.severed) {
            ends.emplace_back(body.pointOf[static_cast<std::size_t>(a)], body.pointOf[static_cast<std::size_t>(b)]);
            for (const int s : strength_->between(ends.back().first, ends.back().second)) {
                if (plan_.origins[static_cast<std::size_t>(s)].body != static_cast<int>(number)) continue;
                if (plan_.broken[static_cast<std::size_t>(s)]) continue;
                remember(s);
                plan_.broken[static_cast<std::size_t>(s)] = true;
                plan_.springs[static_cast<std::size_t>(s)].stiffness = 0;
                changed.push_back(s);
            }
        }
    }
    for (const auto& [a, b] : ends)
        for (const int s : strength_->around(a, b)) dynamics_->watchLength(s, strength_->limitsOf(s));
    if (isSurfaceLess) dynamics_->setForces(forces_);
    hasTorn_ = true;
}

void Island::remember(int spring) {
    const auto s = static_cast<std::size_t>(spring);
    isRemembered_.resize(plan_.springs.size(), false);
    if (isRemembered_[s]) return;
    isRemembered_[s] = true;
    given_.push_back({spring, plan_.springs[s].stiffness, plan_.springs[s].restLength, plan_.broken[s]});
}

void Island::remember(Body& body) {
    if (std::none_of(damaged_.begin(), damaged_.end(), [&](const auto& kept) { return kept.first == &body; }))
        damaged_.emplace_back(&body, body.damage);
}

void Island::keepGiven() {
    for (const Given& was : given_) isRemembered_[static_cast<std::size_t>(was.spring)] = false;
    given_.clear();
    damaged_.clear();
    hasTorn_ = false;
}

// What has given way and torn since the tick began holds again.
void Island::takeBackGiven() {
    if (given_.empty()) return;
    for (const Given& was : given_) {
        const auto s = static_cast<std::size_t>(was.spring);
        plan_.springs[s].stiffness = was.stiffness;
        plan_.springs[s].restLength = was.restLength;
        plan_.broken[s] = was.isBroken;
    }
    for (auto& [body, damage] : damaged_) body->damage = std::move(damage);
    dynamics_->take(Changes{}.add(hasTorn_ ? Change::shape : Change::lengths), forces_);
    keepGiven();
    watchPlasticity();
}

void Island::watchPlasticity() {
    mayGiveWay_ = std::any_of(plan_.bodies.begin(), plan_.bodies.end(), [](const Body* body) {
        return body->plasticity.yieldStrain || body->plasticity.breakStrain;
    });
    if (!mayGiveWay_) return;
    if (!strength_) strength_ = std::make_unique<const Strength>(plan_);
    dynamics_->watchLengths(strength_->limits());
}

}  // namespace taut::world
