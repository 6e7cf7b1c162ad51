// Colliders of a world: where they are, where they go in a tick, and what they carry.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "taut/ecs/entity.h"
#include "taut/island/private/island.h"
#include "taut/spec/collider_spec.h"
#include "taut/world/private/collider_surfaces.h"

namespace taut::world {

struct WorldImpl;

ecs::Entity addCollider(WorldImpl& w, const ColliderSpec& collider);
void letGo(WorldImpl& w, const std::string& collider);  // of all that is tied to it
// Islands take over which there are, where, and of what friction.
void rebuildColliders(WorldImpl& w);

// Where each is when the coming tick ends.
void placeColliders(WorldImpl& w);
// Those that move in this tick, and those that came to rest after the last.
std::vector<ColliderMotion> movingColliders(WorldImpl& w);
// Where they carry what is tied to them in the coming tick.
void carryTied(WorldImpl& w);

std::optional<collision::Pose> poseOf(const WorldImpl& w, const std::string& collider);
std::vector<TouchedCollider> touchedColliders(const WorldImpl& w);  // as the contact stage asks for them

}  // namespace taut::world
