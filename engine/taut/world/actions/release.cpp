// A hand lets go.
#include <algorithm>

#include "taut/world/private/actions/rows.h"
#include "taut/world/private/impl.h"

namespace taut::world {

Kind<ActionSpec> releaseKind() {
    return actionKind<ReleaseAction>(withId<ReleaseAction>(), needsId);
}

void ReleaseAction::perform(World& world) const {
    WorldImpl& w = WorldAccess::of(world);
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
