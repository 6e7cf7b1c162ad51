#include "taut/joints/joints.h"
#include "taut/joints/private/only_constraint.h"
#include "taut/mechanics/pose_path.h"
#include "taut/plan/island_plan.h"
#include "taut/plan/private/pins.h"
#include "taut/spec/common_rows.h"

namespace taut::world {

// All points of the cluster start at the first held point, or else at the first point. Places between points wait for
// Pins::settle().
void WeldJoint::tie(IslandPlan& plan, const Spot& first, const Spot& second, double) const {
    if (first == second) return;
    std::vector<int> cluster;
    changeOnly<Pins>(plan, [&](Pins& pins) {
        pins.tie(first, second, source);
        if (first.isPoint() && second.isPoint()) cluster = pins.clusterOf(first.nearest());
    });
    if (cluster.empty()) return;
    const auto held = std::find_if(cluster.begin(), cluster.end(),
                                   [&](int i) { return plan.points[static_cast<std::size_t>(i)].held; });
    const int leader = held != cluster.end() ? *held : cluster.front();
    for (const int i : cluster)
        plan.positions[static_cast<std::size_t>(i)] = plan.positions[static_cast<std::size_t>(leader)];
}

void WeldJoint::carry(IslandPlan& plan, const Spot& end, Grip grip) const {
    changeOnly<Pins>(plan, [&](Pins& pins) {
        pins.tie(end, Constraint::Place{grip.holder, grip.offsets.front()}, source);
    });
    carryBy(plan, grip.holder, grip.path);
}

Kind<JointSpec> weldKind() {
    return jointKind<WeldJoint>(
        "A weld makes points one; a collider carries all points that are welded to it as they lie when the scene "
        "starts, or at `place`. Of one body, or with a name, break_N or a finish, it keeps points in one place, and "
        "they stay two. "
        "A whole solid (solid.NAME@all) carries points as they lie, like a collider; two whole solids become one rigid "
        "body, each of a with the nearest of b, as far as that is.",
        fields::FieldList<WeldJoint>()
            .number("reach_m", &WeldJoint::furthest, "m", fields::Range{0.0, 1e3},
                    "Largest distance of two points that a weld makes one.")
            .only({"a weld"}));
}

}  // namespace taut::world
