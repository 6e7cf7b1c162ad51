#include "taut/world/private/hands.h"

#include <algorithm>
#include <cmath>

#include "taut/world/private/impl.h"
#include "taut/spec/private/motion.h"
#include "taut/spec/private/rotation.h"
#include "taut/bodies/private/ties.h"

namespace taut::world {

double shareOfWay(Ease ease, double ticks, std::int64_t length) {
    const double part = ticks / static_cast<double>(length);
    return part <= 0 ? 0.0 : part >= 1 ? 1.0 : eased(ease, part);
}

std::int64_t ticksIn(double seconds, double ticksPerSecond) {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(seconds * ticksPerSecond + 0.5)));
}

dvec3 Hand::placeAt(std::int64_t tick) const {
    const double share = shareOfWay(ease, static_cast<double>(tick - start), length);
    return share >= 1 ? to : from + share * (to - from);
}

dvec3 Hand::anglesAt(std::int64_t tick) const {
    const double share = shareOfWay(ease, static_cast<double>(tick - start), length);
    return share >= 1 ? turnedTo : turnedFrom + share * (turnedTo - turnedFrom);
}

collision::Pose Hand::poseAt(std::int64_t tick) const {
    return {placeAt(tick), isTurned() ? rotationOf(anglesAt(tick)) : glm::dquat(1, 0, 0, 0)};
}

Hand& World::Impl::handOf(const ActionSpec& action, const std::string& id) {
    for (Hand& hand : hands)
        if (hand.id == id) return hand;
    failAction(action, "there is no hand \"" + id + "\" now; grab with it first");
}

// Where hands go in the coming tick. What they hold starts anew when their speed changes: the extrapolated velocities
// and stored accelerations of methods know nothing of it.
void World::Impl::leadHands() {
    for (Hand& hand : hands) {
        const collision::Pose from = hand.poseAt(tick), to = hand.poseAt(tick + 1);
        const dvec3 rate = (to.position - from.position) * ticksPerSecond;
        const double t0 = now().start(), t1 = t0 + 1.0 / ticksPerSecond;
        const mechanics::PosePath path(mechanics::LinearPath::line(from.position, rate, t0), from.rotation, to.rotation,
                                       t0, t1);
        const bool bends = rate != hand.rate || isOther(hand.spin, path.at(t0).spin);
        for (const auto& island : islands) island->lead(now(), hand.id, path, bends);
        hand.rate = rate;
        hand.spin = path.at(t1).spin;
    }
    carryTied();
}

void World::Impl::carryTied() {
    if (std::none_of(islands.begin(), islands.end(), [](const auto& island) {
            return !island->plan().grips.empty() || !island->plan().carriers.empty();
        }))
        return;
    registry.each<Identity, ColliderPart>([&](ecs::Entity entity, const Identity& identity, const ColliderPart&) {
        const Placement& placement = *registry.find<Placement>(entity);
        const mechanics::PosePath path = pathOf(placement.from, placement.to, now().start(), ticksPerSecond);
        for (const auto& island : islands) island->carry(now(), identity.fullName(), path);
    });
}

void World::Impl::letGo(const std::string& collider) {
    const auto isOwn = [&](const Grip& grip) { return grip.ofCollider && grip.holder == collider; };
    for (const auto& island : islands) {
        island->release(now(), [&](const JointTie& tie) { return tie.collider == collider; });
        const std::vector<Grip>& grips = island->plan().grips;
        if (island->frozen() != nullptr || std::none_of(grips.begin(), grips.end(), isOwn)) continue;
        std::erase_if(island->change(now(), Change::grips).grips, isOwn);
    }
}

std::optional<collision::Pose> World::Impl::poseOf(const std::string& collider) const {
    std::optional<collision::Pose> pose;
    registry.each<Identity, ColliderPart>([&](ecs::Entity entity, const Identity& identity, const ColliderPart&) {
        if (!pose && identity.fullName() == collider) pose = registry.find<Placement>(entity)->to;
    });
    return pose;
}

std::optional<glm::dvec3> World::handPlace(const std::string& id) const {
    for (const Hand& hand : impl_->hands)
        if (hand.id == id) return hand.placeAt(impl_->tick);
    return std::nullopt;
}

}  // namespace taut::world
