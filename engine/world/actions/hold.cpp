// Points are pinned where they are, or free to move.
#include "taut/world/actions/rows.h"
#include "taut/world/impl.h"

namespace taut::world {

Kind<ActionSpec> holdKind() {
    return actionKind<HoldAction>(withPoints<HoldAction>(), needsTarget);
}
Kind<ActionSpec> freeKind() {
    return actionKind<FreeAction>(withPoints<FreeAction>(), needsTarget);
}

namespace {

void pin(const PointsAction& action, WorldImpl& w, bool isHeld) {
    for (const auto& [island, numbers] : byIsland(w.pick(action))) {
        IslandPlan& plan = island->change(w.now(), Change::points);
        for (int i : numbers) plan.points[static_cast<std::size_t>(i)].held = isHeld;
        if (isHeld) island->stop(w.now(), numbers);
    }
}

}  // namespace

void HoldAction::perform(World& world) const {
    pin(*this, WorldAccess::of(world), true);
}
void FreeAction::perform(World& world) const {
    pin(*this, WorldAccess::of(world), false);
}

}  // namespace taut::world
