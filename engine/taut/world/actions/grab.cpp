// Lets a hand take hold of points.
#include <algorithm>

#include "taut/fields/private/problems.h"
#include "taut/spec/targets.h"
#include "taut/world/private/actions/rows.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/joints.h"
#include "taut/world/private/timeline.h"

namespace taut::world {

Kind<ActionSpec> grabKind() {
    using fields::Range;
    return actionKind<GrabAction>(
        withPoints(withId<GrabAction>())
            .number("radius", &GrabAction::radius, "m", Range{0.0, 1e6},
                    "Points of the same bodies within this distance of such a point too.")
            .flag("rigid", &GrabAction::rigid, "Whether the points are led exactly; else springs draw them.")
            .number("strength_N_per_m", &GrabAction::strength, "N/m", fields::positive,
                    "Of the whole hand, shared by mass.")
            .number("damping_ratio", &GrabAction::dampingRatio, "", Range{0.0, 10.0},
                    "Of the grabbed mass on the hand's spring.")
            .number("max_force_N", &GrabAction::maxForce, "N", fields::positive,
                    "The hand pulls no harder than this, and slips instead; any force if left out. Shared by mass."),
        [](const fields::CheckInput& input, const GrabAction& grab) {
            needsTarget(input, grab);
            needsId(input, grab);
            if (grab.rigid && grab.maxForce)
                input.problems.addError(input.at("max_force_N"), "a rigid hand leads its points with unlimited force",
                                        "leave max_force_N or rigid out");
        });
}

// Takes hold of the named points, and of those within the radius of one of them, at their places. The hand is at the
// mean of the named points.
void GrabAction::perform(World& world) const {
    WorldImpl& w = WorldAccess::of(world);
    if (std::any_of(w.hands.begin(), w.hands.end(), [&](const Hand& h) { return h.id == id; }))
        failAction(*this, "there is a hand \"" + id + "\" already; release it first");
    if (isJoint(w, id)) failAction(*this, "\"" + id + "\" is the name of a joint; give the hand another id");
    std::vector<Picked> points = pick(w, *this);
    // The hand at the mean of the named points.
    Hand hand;
    hand.id = id;
    hand.rigid = rigid;
    for (const Picked& p : points) hand.from += p.island->position(p.point) / static_cast<double>(points.size());
    hand.to = hand.from;
    hand.start = w.tick;
    // All points of the bodies within the radius; then only the free ones.
    if (radius > 0) {
        GrabAction bodiesOnly = *this;
        bodiesOnly.target = withoutSelector(target);
        bodiesOnly.near.reset();
        const std::vector<Picked> named = points;
        points.clear();
        for (const Picked& candidate : pick(w, bodiesOnly)) {
            const dvec3 x = candidate.island->position(candidate.point);
            if (std::any_of(named.begin(), named.end(), [&](const Picked& p) {
                    const dvec3 d = p.island->position(p.point) - x;
                    return glm::dot(d, d) <= radius * radius;
                }))
                points.push_back(candidate);
        }
    }
    std::erase_if(points, [](const Picked& p) { return !isFree(p.island->plan(), p.point); });
    if (points.empty()) failAction(*this, "every point of \"" + target + "\" is held already; free them first");

    // One grip for each island; the points share the hand's strength by mass.
    double mass = 0;
    for (const Picked& p : points) mass += massOf(p);
    const GripRates rates = gripRates(strength, dampingRatio, mass);
    for (const auto& [island, numbers] : byIsland(points)) {
        Grip grip;
        grip.holder = id;
        grip.rigid = rigid;
        grip.points = numbers;
        grip.path = mechanics::LinearPath{hand.from, hand.from};
        IslandPlan& plan = island->change(w.now(), Change::grips);
        for (int i : numbers) {
            const double share = plan.points[i].mass;
            grip.offsets.push_back(island->position(i) - hand.from);
            if (rigid) continue;
            grip.stiffness.push_back(share * rates.omega2);
            grip.damping.push_back(share * rates.damping);
            if (maxForce) grip.mostForce.push_back(share / mass * *maxForce);
        }
        plan.grips.push_back(std::move(grip));
        if (rigid) island->stop(w.now(), numbers);
    }
    w.hands.push_back(std::move(hand));
}

}  // namespace taut::world
