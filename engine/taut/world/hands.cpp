#include "taut/world/private/hands.h"

#include <algorithm>
#include <cmath>

#include "taut/plan/private/ties.h"
#include "taut/spec/private/motion.h"
#include "taut/spec/private/rotation.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/timeline.h"

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

Hand& handOf(WorldImpl& w, const ActionSpec& action, const std::string& id) {
    for (Hand& hand : w.hands)
        if (hand.id == id) return hand;
    failAction(action, "there is no hand \"" + id + "\" now; grab with it first");
}

void loosen(WorldImpl& w, const std::string& holder, bool isCollider) {
    const auto isOwn = [&](const Grip& grip) { return grip.ofCollider == isCollider && grip.holder == holder; };
    for (const auto& island : w.islands) {
        const std::vector<Grip>& grips = island->plan().grips;
        if (island->frozen() != nullptr || std::none_of(grips.begin(), grips.end(), isOwn)) continue;
        std::erase_if(island->change(w.now(), Change::grips).grips, isOwn);
    }
}

// Islands start again when a hand changes its speed, because extrapolated velocities and stored accelerations of
// methods do not contain the change.
void leadHands(WorldImpl& w) {
    for (Hand& hand : w.hands) {
        const collision::Pose from = hand.poseAt(w.tick), to = hand.poseAt(w.tick + 1);
        const dvec3 rate = (to.position - from.position) * w.ticksPerSecond;
        const double t0 = w.now().start(), t1 = t0 + 1.0 / w.ticksPerSecond;
        const mechanics::PosePath path(mechanics::LinearPath::line(from.position, rate, t0), from.rotation, to.rotation,
                                       t0, t1);
        const bool bends = rate != hand.rate || isOther(hand.spin, path.at(t0).spin);
        for (const auto& island : w.islands) island->lead(w.now(), hand.id, path, bends);
        hand.rate = rate;
        hand.spin = path.at(t1).spin;
    }
}

}  // namespace taut::world
