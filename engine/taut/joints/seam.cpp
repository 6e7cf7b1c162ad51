#include "taut/core/error.h"
#include "taut/fields/private/problems.h"
#include "taut/joints/joints.h"
#include "taut/joints/private/only_constraint.h"
#include "taut/plan/island_plan.h"
#include "taut/plan/private/pins.h"
#include "taut/spec/common_rows.h"

namespace taut::world {

// The plan has the right length: welding may have moved the points away from their bodies' positions.
void SeamJoint::tie(IslandPlan& plan, const Spot& first, const Spot& second, double distance) const {
    if (isWeld()) {
        WeldJoint weld;
        weld.source = source;
        return weld.tie(plan, first, second, distance);
    }
    const dvec3 d = second.of(plan.positions) - first.of(plan.positions);
    const double length = start > 0 ? Pins::Closing::notBegun : std::sqrt(glm::dot(d, d));
    changeOnly<Pins>(plan, [&](Pins& pins) { pins.sew(first, second, {length, over, start}, source); });
}

void SeamJoint::carry(IslandPlan&, const Spot&, Grip grip) const {
    throw core::Error(core::ErrorKind::badContent, at(source) + "a seam sews edges of bodies, and " + grip.holder +
                                                       " is a collider; use a [[joint]]");
}

Kind<JointSpec> seamKind() {
    Kind<JointSpec> kind = jointKind<SeamJoint>(
        "Sews two edges together. Each point goes with the place on the other edge at the same share of the length, in "
        "the direction in which they lie nearer; around a closed edge, also from where they lie nearest.",
        fields::FieldList<SeamJoint>()
            .number(
                "over_s", &SeamJoint::over, "s", fields::notNegative,
                "From its start until it is closed; until then points are drawn together. 0: they meet as the scene "
                "starts.")
            .number("start_s", &SeamJoint::start, "s", fields::notNegative,
                    "When it begins to close; before, nothing draws its points."));
    std::erase_if(kind.section.fields, [](const fields::Field& row) {
        return row.key == "place" || row.key == "place_in" || row.key == "touch";
    });
    for (fields::Field& row : kind.section.fields)
        if (row.key == "a" || row.key == "b") {
            row.role = fields::Role::points;
            row.help = row.key == "a" ? "An edge: KIND.NAME@SELECTOR, or a list of edges that follow each other."
                                      : "The other, of the same bodies or of others.";
        }
    kind.section.check = [](const fields::CheckInput& input, void* target) {
        const auto& seam = *static_cast<const SeamJoint*>(target);
        checkJoint(input, seam);
        if (seam.start > 0 && !(seam.over > 0))
            input.problems.addError(input.at("start_s"), "a seam that starts later takes a time to close",
                                    "give a time, e.g. over_s = 0.5");
    };
    return kind;
}

}  // namespace taut::world
