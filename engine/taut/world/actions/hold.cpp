// Pins points in place or to a collider, or frees them.
#include <algorithm>

#include "taut/fields/private/problems.h"
#include "taut/plan/private/ties.h"
#include "taut/world/private/actions/rows.h"
#include "taut/world/private/colliders.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/timeline.h"

namespace taut::world {

Kind<ActionSpec> holdKind() {
    return actionKind<HoldAction>(
        withPoints<HoldAction>().text("hold_on", &HoldAction::holdOn, fields::Role::collider, holdOnHelp), needsTarget);
}
Kind<ActionSpec> freeKind() {
    return actionKind<FreeAction>(withPoints<FreeAction>(), needsTarget);
}

namespace {

bool isInHand(const IslandPlan& plan, int point) {
    return std::any_of(
        plan.grips.begin(), plan.grips.end(),
        [&](const Grip& grip) {
            return grip.rigid && !grip.ofCollider && std::binary_search(grip.points.begin(), grip.points.end(), point);
        });
}

IslandPlan& untied(Island& island, const TickTime& time, std::span<const int> points) {
    IslandPlan& plan = island.change(time, Change::points);
    if (untie(plan, points)) island.change(time, Change::grips);
    return plan;
}

void pin(const PointsAction& action, WorldImpl& w, bool isHeld) {
    for (const auto& [island, numbers] : byIsland(pick(w, action))) {
        IslandPlan& plan = untied(*island, w.now(), numbers);
        if (!isHeld)
            island->release(w.now(), [&own = numbers](const JointTie& tie) {
                return tie.b < 0 && std::binary_search(own.begin(), own.end(), tie.a);
            });
        for (int i : numbers) plan.points[i].held = isHeld;
        if (isHeld) island->stop(w.now(), numbers);
    }
}

}  // namespace

void HoldAction::perform(World& world) const {
    WorldImpl& w = WorldAccess::of(world);
    if (holdOn.empty()) return pin(*this, w, true);
    const Holders holders = holdersOf(w);
    if (!holders.poseOf(holdOn)) failAction(*this, "there is no " + holdOn + " to hold points on");
    std::vector<Picked> points = pick(w, *this);
    std::erase_if(points, [](const Picked& p) { return isInHand(p.island->plan(), p.point); });
    if (points.empty()) failAction(*this, "a hand leads every point of \"" + target + "\"; release them first");
    std::vector<dvec3> x;
    for (const auto& [island, numbers] : byIsland(points)) {
        IslandPlan& plan = untied(*island, w.now(), numbers);
        for (int i : numbers) plan.points[i].held = false;
        x.clear();
        for (std::size_t i = 0; i < plan.points.size(); ++i) x.push_back(island->position(static_cast<int>(i)));
        for (Grip& grip : tieTo(holders, holdOn, numbers, x))
            island->change(w.now(), Change::grips).grips.push_back(std::move(grip));
        island->stop(w.now(), numbers);
    }
}
void FreeAction::perform(World& world) const {
    pin(*this, WorldAccess::of(world), false);
}

}  // namespace taut::world
