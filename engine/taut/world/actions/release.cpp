// A hand lets go.
#include "taut/world/private/actions/rows.h"
#include "taut/world/private/impl.h"

namespace taut::world {

Kind<ActionSpec> releaseKind() {
    return actionKind<ReleaseAction>(withId<ReleaseAction>(), needsId);
}

void ReleaseAction::perform(World& world) const {
    WorldImpl& w = WorldAccess::of(world);
    handOf(w, *this, id);
    loosen(w, id, false);
    std::erase_if(w.hands, [&](const Hand& hand) { return hand.id == id; });
}

}  // namespace taut::world
