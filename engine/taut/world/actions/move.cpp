// Moves a hand or a collider.
#include <algorithm>
#include <cstdio>

#include "taut/core/trig.h"
#include "taut/fields/private/problems.h"
#include "taut/spec/private/rotation.h"
#include "taut/spec/targets.h"
#include "taut/world/private/actions/rows.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/timeline.h"

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
    };
    return actionKind<MoveAction>(
        withWay(withTarget(withId<MoveAction>())
                    .vector("to", &MoveAction::to, "m", fields::anyNumber, endHelp)
                    .rotation("rotation_deg", &MoveAction::rotation,
                              "How it is turned then, about x, then y, then z. A collider turns the short "
                              "way; a hand from 0 where it grabbed by the angles as they "
                              "are, so that [1440, 0, 0] is four turns.")),
        check);
}

namespace {

// In one tick a hand turns the short way, which has to agree with its angles.
void checkPace(const MoveAction& action, const Hand& hand, double ticksPerSecond) {
    constexpr double most = 2.0 / 3.0 * core::pi;
    const dvec3 way = glm::abs(hand.turnedTo - hand.turnedFrom);
    const double angle = way.x + way.y + way.z;
    double largest = 0;  // share of the way in one tick
    for (std::int64_t i = 0; i < hand.length && largest * angle <= most; ++i)
        largest = std::max(largest, shareOfWay(hand.ease, static_cast<double>(i + 1), hand.length) -
                                        shareOfWay(hand.ease, static_cast<double>(i), hand.length));
    if (largest * angle <= most) return;
    char text[120];
    std::snprintf(text, sizeof text, "the hand would turn by %.3g degrees in a tick of 1/%.6g s; %s",
                  largest * angle / core::radians(1.0), ticksPerSecond,
                  hand.ease == Ease::hold ? "take another ease" : "raise over_s, so that it is 120 at most");
    failAction(action, text);
}

void moveHand(const MoveAction& action, WorldImpl& w) {
    Hand& hand = handOf(w, action, action.id);
    if (!action.to && !action.rotation)
        failAction(action, "the hand has no destination: `to` or `rotation_deg` is missing");
    hand.from = hand.placeAt(w.tick);
    hand.to = action.to.value_or(hand.from);
    hand.turnedFrom = hand.anglesAt(w.tick);
    hand.turnedTo = action.rotation.value_or(hand.turnedFrom);
    hand.start = w.tick;
    hand.length = ticksIn(action.over, w.ticksPerSecond);
    hand.ease = action.ease;
    checkPace(action, hand, w.ticksPerSecond);
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
