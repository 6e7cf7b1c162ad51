#include "taut/spec/common_rows.h"
#include "taut/bodies/island_plan.h"
#include "taut/bodies/joints/joints.h"

namespace taut::world {

void WeldJoint::carry(IslandPlan&, Grip) const {}

Kind<JointSpec> weldKind() {
    return jointKind<WeldJoint>(
        "A weld makes points one; a collider carries all points that are welded to it as they lie when the scene "
        "starts.",
        fields::FieldList<WeldJoint>()
            .number("reach_m", &WeldJoint::furthest, "m", fields::Range{0.0, 1e3},
                    "Largest distance of two points that a weld makes one.")
            .only({"a weld"}));
}

}  // namespace taut::world
