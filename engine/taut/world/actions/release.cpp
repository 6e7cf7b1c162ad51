// Releases a hand, or the joints of a name.
#include <algorithm>

#include "taut/world/private/actions/rows.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/joints.h"

namespace taut::world {

Kind<ActionSpec> releaseKind() {
    return actionKind<ReleaseAction>(
        fields::FieldList<ReleaseAction>().text("id", &ReleaseAction::id, fields::Role::none,
                                                "Name of the hand, or of joints to release."),
        needsId);
}

void ReleaseAction::perform(World& world) const {
    WorldImpl& w = WorldAccess::of(world);
    const bool isHand = std::any_of(w.hands.begin(), w.hands.end(), [&](const Hand& hand) { return hand.id == id; });
    if (!isHand && isJoint(w, id)) return releaseJoints(w, id);
    handOf(w, *this, id);
    loosen(w, id, false);
    std::erase_if(w.hands, [&](const Hand& hand) { return hand.id == id; });
}

}  // namespace taut::world
