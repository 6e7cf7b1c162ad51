#include "taut/world/hands.h"

#include <algorithm>
#include <cmath>

#include "taut/world/impl.h"
#include "taut/world/motion.h"
#include "taut/world/targets.h"

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

// Takes hold of the points named and of those within the radius of one of them, where they are. The hand is at the
// mean of the points named.
void World::Impl::grab(const ActionSpec& action) {
    if (std::any_of(hands.begin(), hands.end(), [&](const Hand& h) { return h.id == action.id; }))
        failAction(action, "there is a hand \"" + action.id + "\" already; release it first");
    std::vector<Picked> points = pick(action);
    Hand hand;
    hand.id = action.id;
    hand.rigid = action.rigid;
    for (const Picked& p : points) hand.from += p.island->position(p.point) / static_cast<double>(points.size());
    hand.to = hand.from;
    hand.start = tick;
    if (action.radius > 0) {
        ActionSpec bodiesOnly = action;
        bodiesOnly.target = action.target.substr(0, action.target.find('@'));
        bodiesOnly.near.reset();
        const std::vector<Picked> named = points;
        points.clear();
        for (const Picked& candidate : pick(bodiesOnly)) {
            const dvec3 x = candidate.island->position(candidate.point);
            if (std::any_of(named.begin(), named.end(), [&](const Picked& p) {
                    const dvec3 d = p.island->position(p.point) - x;
                    return glm::dot(d, d) <= action.radius * action.radius;
                }))
                points.push_back(candidate);
        }
    }
    std::erase_if(points, [](const Picked& p) { return !isFree(p.island->plan(), p.point); });
    if (points.empty()) failAction(action, "every point of \"" + action.target + "\" is held already");

    double mass = 0;
    for (const Picked& p : points) mass += p.island->plan().points[static_cast<std::size_t>(p.point)].mass;
    const GripRates rates = gripRates(action.strength, action.dampingRatio, mass);
    for (const auto& [island, numbers] : byIsland(points)) {
        Grip grip;
        grip.hand = action.id;
        grip.rigid = action.rigid;
        grip.points = numbers;
        grip.path = {hand.from, hand.from};
        IslandPlan& plan = island->change(now(), Change::grips);
        for (int i : numbers) {
            const double share = plan.points[static_cast<std::size_t>(i)].mass;
            grip.offsets.push_back(island->position(i) - hand.from);
            if (action.rigid) continue;
            grip.stiffness.push_back(share * rates.omega2);
            grip.damping.push_back(share * rates.damping);
        }
        plan.grips.push_back(std::move(grip));
        if (action.rigid) island->stop(now(), numbers);
    }
    hands.push_back(std::move(hand));
}

Hand& World::Impl::handOf(const ActionSpec& action) {
    for (Hand& hand : hands)
        if (hand.id == action.id) return hand;
    failAction(action, "there is no hand \"" + action.id + "\" now; grab with it first");
}

void World::Impl::moveHand(const ActionSpec& action) {
    Hand& hand = handOf(action);
    if (!action.to) failAction(action, "it is not said where the hand goes: `to` is missing");
    hand.from = hand.placeAt(tick);
    hand.to = *action.to;
    hand.start = tick;
    hand.length = ticksIn(action.over, ticksPerSecond);
    hand.ease = action.ease;
}

void World::Impl::release(const ActionSpec& action) {
    handOf(action);
    for (const auto& island : islands) {
        const std::vector<Grip>& grips = island->plan().grips;
        if (island->frozen() != nullptr ||
            std::none_of(grips.begin(), grips.end(), [&](const Grip& g) { return g.hand == action.id; }))
            continue;
        std::erase_if(island->change(now(), Change::grips).grips, [&](const Grip& g) { return g.hand == action.id; });
    }
    std::erase_if(hands, [&](const Hand& h) { return h.id == action.id; });
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
