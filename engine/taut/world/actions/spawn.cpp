// Makes a body appear that was built at the start and has waited.
#include "taut/world/private/actions/rows.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/timeline.h"

namespace taut::world {

Kind<ActionSpec> spawnKind() {
    return actionKind<SpawnAction>(withTarget<SpawnAction>(), needsTarget);
}

void SpawnAction::perform(World& world) const {
    if (!spawnWaiting(WorldAccess::of(world), target))
        failAction(*this, "no body \"" + target + "\" waits to be spawned");
}

}  // namespace taut::world
