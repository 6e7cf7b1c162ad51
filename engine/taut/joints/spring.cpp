#include "taut/joints/joints.h"
#include "taut/joints/private/only_constraint.h"
#include "taut/joints/private/place_ties.h"
#include "taut/plan/island_plan.h"
#include "taut/spec/common_rows.h"

namespace taut::world {

void SpringJoint::tie(IslandPlan& plan, const Spot& first, const Spot& second, double distance) const {
    const double length = restLength.value_or(distance);
    if (first.isPoint() && second.isPoint())
        plan.springs.push_back(
            {first.nearest(), second.nearest(), stiffness, length, dampingTime, mechanics::SpringKind::joint});
    else
        changeOnly<PlaceTies>(plan, [&](PlaceTies& ties) {
            ties.tie(first, second, {0, 0, stiffness, stiffness * dampingTime, length});
        });
}

// Springs draw each point to a place on the collider.
void SpringJoint::carry(IslandPlan& plan, const Spot& end, Grip grip) const {
    if (!end.isPoint()) {
        changeOnly<PlaceTies>(plan, [&](PlaceTies& ties) {
            ties.tie(end, Constraint::Place{grip.holder, grip.offsets.front()},
                     {0, 0, stiffness, stiffness * dampingTime, restLength.value_or(0.0)});
        });
        return carryBy(plan, grip.holder, grip.path);
    }
    grip.rigid = false;
    grip.stiffness.assign(grip.points.size(), stiffness);
    grip.damping.assign(grip.points.size(), stiffness * dampingTime);
    if (restLength.value_or(0.0) > 0.0) grip.lengths.assign(grip.points.size(), *restLength);
    plan.grips.push_back(std::move(grip));
}

Kind<JointSpec> springKind() {
    return jointKind<SpringJoint>(
        "Springs draw points or places together, and to a collider each to where it is as the scene starts, or all to "
        "`place`.",
        fields::FieldList<SpringJoint>()
            .number("stiffness_N_per_m", &SpringJoint::stiffness, "N/m", fields::positive, "Of each spring.")
            .number("damping_time_s", &SpringJoint::dampingTime, "s", dampingTimeRange, "Of each spring.")
            .number(
                "rest_length_m", &SpringJoint::restLength, "m", fields::notNegative,
                "At which a spring pulls no more; the distance as the scene starts if not given, to a collider 0."));
}

}  // namespace taut::world
