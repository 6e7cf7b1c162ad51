// A hand lets go, or the joints of a name.
#include <algorithm>

#include "taut/world/private/actions/rows.h"
#include "taut/world/private/impl.h"

namespace taut::world {

Kind<ActionSpec> releaseKind() {
    return actionKind<ReleaseAction>(
        fields::FieldList<ReleaseAction>().text("id", &ReleaseAction::id, fields::Role::none,
                                                "Name of the hand; or of joints, all of which let go."),
        needsId);
}

void ReleaseAction::perform(World& world) const {
    WorldImpl& w = WorldAccess::of(world);
    const bool isHand = std::any_of(w.hands.begin(), w.hands.end(), [&](const Hand& hand) { return hand.id == id; });
    if (!isHand && w.isJoint(id)) return w.releaseJoints(id);
    w.handOf(*this, id);
    const auto isOwn = [&](const auto& held) { return !held.ofCollider && held.holder == id; };
    for (const auto& island : w.islands) {
        const std::vector<Grip>& grips = island->plan().grips;
        if (island->frozen() != nullptr || std::none_of(grips.begin(), grips.end(), isOwn)) continue;
        std::erase_if(island->change(w.now(), Change::grips).grips, isOwn);
    }
    std::erase_if(w.hands, [&](const Hand& hand) { return hand.id == id; });
}

}  // namespace taut::world
