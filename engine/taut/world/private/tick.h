// Takes islands through a tick: islands whose bodies touch together, all others in parallel.
#pragma once

#include <optional>
#include <vector>

#include "taut/island/private/island.h"
#include "taut/world/private/contact_report.h"

namespace taut::world {

struct WorldImpl;

// After the actions between two ticks: the islands that they opened start again.
void closeIslands(WorldImpl& w);
// If one diverges, the state at the start of the tick returns, unless the scene asks for freezing.
std::optional<Divergence> tickIslands(WorldImpl& w, const std::vector<ColliderMotion>& moving);
void updateHash(WorldImpl& w);

// Contact between bodies. The latter two make the stage if it is missing.
bool touchesAny(const WorldImpl& w);
void makeContactStage(WorldImpl& w);
std::vector<BodyCrossing> crossingsOf(WorldImpl& w);

}  // namespace taut::world
