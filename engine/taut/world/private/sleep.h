// Sleep ([solver] sleep_error_m): islands that rest keep their places and are not computed until something could move
// them.
//
//     a tick     actions, forces, hands, colliders ... wakeReached() ... the tick: contact wakes ... letSleep()
//
// Falling asleep, at the end of a window of half a second (rest_watch.h), in a serial order:
// - an island is calm if none of its points went further than a third of the error in the window;
// - it rests if in addition no point could go further than another third: see rest_bound.h. Points held by friction
//   count as held: at colliders if they did not slide in the window, between bodies if the friction in the last tick
//   was below 0.9 of the limit by Coulomb, if anything of the company is held or rubs on a collider;
// - a solid rests if friction holds it so at three places or more that are not on one line, and none of its points went
//   further than a hundredth of the error in the window;
// - islands that press each other fall asleep together, as a company, once all of them rest.
//
// Waking, the whole company at once: any change of an island, of its forces or its grips, and a moving collider near
// it, before the tick; contact with a body that is awake, within the tick, which is then repeated. A collider that
// comes, and a body or collider that goes, wake all.
//
// Restorable: the data of islands is saved with them. Nothing here outlives a tick.
#pragma once

#include <span>

#include "taut/island/private/island.h"

namespace taut::world {

struct WorldImpl;

// Before the tick: wakes companies in which an island was opened, or is reached by a collider that moves.
void wakeReached(WorldImpl& w, std::span<const ColliderMotion> moving);
void wakeAll(WorldImpl& w);
// After the tick.
void letSleep(WorldImpl& w);
// Whether islands may fall asleep at the end of the coming tick.
bool endsRestWindow(const WorldImpl& w);

}  // namespace taut::world
