// The colliders of a world: their places, their motion in a tick, and the points that they carry.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "taut/ecs/entity.h"
#include "taut/island/private/island.h"
#include "taut/plan/private/ties.h"
#include "taut/spec/collider_spec.h"
#include "taut/world/components.h"
#include "taut/world/private/collider_surfaces.h"

namespace taut::world {

struct WorldImpl;

ecs::Entity addCollider(WorldImpl& w, const ColliderSpec& collider);
void letGo(WorldImpl& w, const std::string& collider);  // frees all that is tied to it
// Gives the islands the present colliders, with their poses and friction.
void rebuildColliders(WorldImpl& w);

// Computes the pose of each collider at the end of the coming tick.
void placeColliders(WorldImpl& w);
// The colliders that move in this tick, and the ones that came to rest after the last tick.
std::vector<ColliderMotion> movingColliders(WorldImpl& w);
// Carries the points tied to colliders through the coming tick.
void carryTied(WorldImpl& w);

Holders holdersOf(const WorldImpl& w);  // as long as it lives
// Of a collider, or of a joint or face of a figure (parseCollider()), `ahead` [s] after now if it goes on as in the
// previous tick; none: there is none of that name.
std::optional<collision::Pose> poseOf(const WorldImpl& w, const std::string& holder, double ahead);
// The pose of a collider if it goes on so.
collision::Pose poseAhead(const Placement& placement, double ticks);
std::vector<TouchedCollider> touchedColliders(const WorldImpl& w);  // as the contact stage needs them

}  // namespace taut::world
