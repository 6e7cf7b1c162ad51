#include <algorithm>
#include <cmath>

#include "taut/joints/joints.h"
#include "taut/joints/private/only_constraint.h"
#include "taut/joints/private/rods.h"
#include "taut/mechanics/pose_path.h"
#include "taut/plan/island_plan.h"
#include "taut/spec/common_rows.h"

namespace taut::world {
namespace {

double distance(const dvec3& a, const dvec3& b) {
    const dvec3 d = b - a;
    return std::sqrt(glm::dot(d, d));
}

}  // namespace

// The plan has the right length: welding may have moved the points away from their bodies' positions.
void RodJoint::tie(IslandPlan& plan, const Spot& first, const Spot& second, double) const {
    const double length = distance(first.of(plan.positions), second.of(plan.positions));
    changeOnly<Rods>(plan, [&](Rods& rods) { rods.tie(first, second, length, source); });
}

void RodJoint::carry(IslandPlan& plan, const Spot& end, Grip grip) const {
    const mechanics::PosePath::Frame frame = grip.path.at(0.0);
    const dvec3 offset = place ? grip.offsets.front() : dvec3(0.0);
    const double length = distance(end.of(plan.positions), frame.place + frame.arm(offset));
    changeOnly<Rods>(plan, [&](Rods& rods) { rods.tie(end, Constraint::Place{grip.holder, offset}, length, source); });
    carryBy(plan, grip.holder, grip.path);
}

Kind<JointSpec> rodKind() {
    return jointKind<RodJoint>(
        "Rods keep the distance that points have as the scene starts, from each other, which may be of one body, or "
        "from a place on a rigid body or on a collider, whose centre it is if not given.");
}

}  // namespace taut::world
