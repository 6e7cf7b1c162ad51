// Cuts bodies along a plane or a line.
#include <algorithm>

#include "taut/fields/private/problems.h"
#include "taut/island/private/cutting.h"
#include "taut/world/private/actions/rows.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/timeline.h"

namespace taut::world {

Kind<ActionSpec> cutKind() {
    const auto check = [](const fields::CheckInput& input, const CutAction& cut) {
        needsTarget(input, cut);
        if (!input.isClean) return;
        if (cut.planePoint && cut.from)
            input.problems.addError(input.at("segment"), "a cut has a plane or a segment, not both",
                                    "leave one out; without either all of the body comes apart");
        if (cut.from && *cut.from == *cut.upTo)
            input.problems.addError(input.at("segment"), "the two ends of the cut are the same point");
        if (cut.planeNormal && glm::dot(*cut.planeNormal, *cut.planeNormal) < fields::smallest * fields::smallest)
            input.problems.addError(input.at("plane"), "the normal of the plane must not be [0, 0, 0]");
    };
    return actionKind<CutAction>(
        withTarget<CutAction>()
            .segment("plane", &CutAction::planePoint, &CutAction::planeNormal, "m", placeRange,
                     "A point and a normal: springs that cross the plane are cut. Without it and a segment all are.")
            .segment("segment", &CutAction::from, &CutAction::upTo, "", fields::share,
                     "From where to where a cloth grid is cut, as shares of its width and height from the top left."),
        check);
}

void CutAction::perform(World& world) const {
    WorldImpl& w = WorldAccess::of(world);
    const std::vector<Body*> bodies = matchBodies(bodiesOf(w), target);
    if (bodies.empty()) failAction(*this, "target = \"" + target + "\" names no body");
    bool any = false;
    for (const auto& island : w.islands) {
        const CutEdges crossing = edgesCutBy(*this, *island, bodies);
        if (crossing.isEmpty()) continue;
        any = true;
        if (island->frozen() == nullptr) sever(crossing, island->change(w.now(), Change::shape));
    }
    const bool areRigid =
        std::all_of(bodies.begin(), bodies.end(), [](const Body* body) { return body->spec->isRigid(); });
    if (!any)
        w.actionWarnings.push_back(
            warningAt(source) +
            (areRigid ? "\"" + target + "\" is rigid: a cut takes its joints alone"
                      : "there is nothing whole of \"" + target + "\" where this cuts; put it where the body is"));
    redrawDamage(w);
}

}  // namespace taut::world
