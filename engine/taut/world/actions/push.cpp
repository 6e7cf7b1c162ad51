// Gives an impulse to the points that can move, in proportion to their masses.
#include "taut/fields/private/problems.h"
#include "taut/world/private/actions/rows.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/timeline.h"

namespace taut::world {

Kind<ActionSpec> pushKind() {
    return actionKind<PushAction>(
        withPoints<PushAction>()
            .vector("impulse_Ns", &PushAction::impulse, "N s", placeRange, "Of all the points, shared by mass.")
            .required(),
        [](const fields::CheckInput& input, const PushAction& push) {
            needsTarget(input, push);
            if (input.isClean && push.impulse == dvec3(0.0))
                input.problems.addError(input.at("impulse_Ns"), "a push of [0, 0, 0] does nothing");
        });
}

void PushAction::perform(World& world) const {
    WorldImpl& w = WorldAccess::of(world);
    std::vector<Picked> points = pick(w, *this);
    std::erase_if(points, [](const Picked& p) { return !isFree(p.island->plan(), p.point); });
    if (points.empty()) failAction(*this, "every point of \"" + target + "\" is held; free them first");
    double mass = 0;
    for (const Picked& p : points) mass += massOf(p);
    for (const auto& [island, numbers] : byIsland(points)) island->push(w.now(), numbers, impulse / mass);
}

}  // namespace taut::world
