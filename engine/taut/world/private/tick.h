// Islands go through a tick: those whose bodies touch together, all others side by side.
#pragma once

#include <optional>
#include <vector>

#include "taut/island/private/island.h"
#include "taut/world/private/contact_report.h"

namespace taut::world {

struct WorldImpl;

// What acts between two ticks is over: islands that it opened start again.
void closeIslands(WorldImpl& w);
// On divergence everything is as it was when the tick began, unless the scene asks for freezing.
std::optional<Divergence> tickIslands(WorldImpl& w, const std::vector<ColliderMotion>& moving);
void updateHash(WorldImpl& w);

// Contact between bodies; the stage is there after the latter two.
bool touchesAny(const WorldImpl& w);
void makeContactStage(WorldImpl& w);
std::vector<BodyCrossing> crossingsOf(WorldImpl& w);

}  // namespace taut::world
