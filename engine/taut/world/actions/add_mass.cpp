// Makes points heavier or lighter.
#include "taut/world/private/actions/rows.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/timeline.h"

namespace taut::world {

Kind<ActionSpec> addMassKind() {
    return actionKind<AddMassAction>(
        withPoints<AddMassAction>()
            .number("mass_kg", &AddMassAction::mass, "kg", fields::positive, "Of all the points, shared evenly.")
            .required(),
        needsTarget);
}

void AddMassAction::perform(World& world) const {
    WorldImpl& w = WorldAccess::of(world);
    const std::vector<Picked> points = pick(w, *this);
    for (const auto& [island, numbers] : byIsland(points)) {
        IslandPlan& plan = island->change(w.now(), Change::points);
        for (int i : numbers) {
            double& now = plan.points[i].mass;
            now += mass / static_cast<double>(points.size());
            if (!(now > 0)) failAction(*this, "this leaves a point of \"" + target + "\" without any mass");
        }
    }
}

}  // namespace taut::world
