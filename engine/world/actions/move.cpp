// A hand or a collider goes somewhere.
#include "taut/fields/problems.h"
#include "taut/world/actions/rows.h"
#include "taut/world/impl.h"
#include "taut/world/rotation.h"
#include "taut/world/targets.h"

namespace taut::world {

Kind<ActionSpec> moveKind() {
    const auto check = [](const fields::CheckInput& input, const MoveAction& move) {
        if (!input.isClean) return;
        const auto has = [&](const char* key) { return input.table.find(key) != nullptr; };
        if (!has("id") && !has("target"))
            reportLack(input, "id or target", "write id = \"HAND\" or target = \"collider.NAME\"");
        if (has("id") && has("target"))
            input.problems.addError(input.at("target"), "a move has id or target, not both",
                                    "a hand has an id, a collider is a target");
        if (!move.to && !move.rotation) reportLack(input, "to", "write to = [x, y, z]");
        if (has("id") && move.rotation)
            input.problems.addError(input.at("rotation_deg"), "a hand is not turned", "only a collider is");
    };
    return actionKind<MoveAction>(withWay(withTarget(withId<MoveAction>())
                                              .vector("to", &MoveAction::to, "m", fields::anyNumber, endHelp)
                                              .rotation("rotation_deg", &MoveAction::rotation,
                                                        "How the collider is turned then, about x, then y, then z.")),
                                  check);
}

namespace {

void moveHand(const MoveAction& action, WorldImpl& w) {
    Hand& hand = w.handOf(action, action.id);
    if (!action.to) failAction(action, "it is not said where the hand goes: `to` is missing");
    hand.from = hand.placeAt(w.tick);
    hand.to = *action.to;
    hand.start = w.tick;
    hand.length = ticksIn(action.over, w.ticksPerSecond);
    hand.ease = action.ease;
}

void moveCollider(const MoveAction& action, WorldImpl& w) {
    bool any = false;
    const Target target = parseTarget(action.target);
    w.registry.each<Identity, ColliderPart>([&](ecs::Entity entity, const Identity& identity, ColliderPart& part) {
        if (target.kind != identity.kind || !matches(target.name, identity.name)) return;
        any = true;
        const collision::Pose from = w.registry.find<Placement>(entity)->to;
        collision::Pose to = from;
        if (action.to) to.position = *action.to;
        if (action.rotation) to.rotation = rotationOf(*action.rotation);
        part.move = PoseMove{from, to, w.tick, ticksIn(action.over, w.ticksPerSecond), action.ease};
    });
    if (!any) failAction(action, "there is no collider \"" + action.target + "\" to move");
}

}  // namespace

void MoveAction::perform(World& world) const {
    (target.empty() ? moveHand : moveCollider)(*this, WorldAccess::of(world));
}

}  // namespace taut::world
