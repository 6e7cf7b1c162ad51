#include "taut/world/hands.h"

#include <algorithm>
#include <cmath>

#include "taut/world/impl.h"
#include "taut/world/motion.h"

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

Hand& World::Impl::handOf(const ActionSpec& action, const std::string& id) {
    for (Hand& hand : hands)
        if (hand.id == id) return hand;
    failAction(action, "there is no hand \"" + id + "\" now; grab with it first");
}

// Where hands go in the coming tick. What they hold starts anew when their speed changes: the extrapolated velocities
// and stored accelerations of methods know nothing of it.
void World::Impl::leadHands() {
    for (Hand& hand : hands) {
        const dvec3 from = hand.placeAt(tick), to = hand.placeAt(tick + 1);
        const dvec3 rate = (to - from) * ticksPerSecond;
        for (const auto& island : islands)
            island->lead(now(), hand.id, mechanics::LinearPath::line(from, rate, now().start()), rate != hand.rate);
        hand.rate = rate;
    }
}

std::optional<glm::dvec3> World::handPlace(const std::string& id) const {
    for (const Hand& hand : impl_->hands)
        if (hand.id == id) return hand.placeAt(impl_->tick);
    return std::nullopt;
}

}  // namespace taut::world
