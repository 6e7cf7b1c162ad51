// Bodies come into a world, each to an island, and leave it; and which forces act on them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "taut/bodies/body.h"
#include "taut/ecs/entity.h"
#include "taut/forces/force.h"

namespace taut::world {

class Island;
struct WorldImpl;

// Those of the scene, with what its joints tie; those that an action will spawn wait.
void addBodies(WorldImpl& w);
// A body becomes an island of its own.
ecs::Entity spawn(WorldImpl& w, Body body);
// Whether any body of that name was waiting.
bool spawnWaiting(WorldImpl& w, const std::string& target);
// From the island, which it has to be alone in, and from what else knows it; the entity is still there.
void removeBody(WorldImpl& w, ecs::Entity entity);

std::vector<Body*> bodiesOf(const WorldImpl& w);  // in the order of the state hash
Island& islandOf(const Body& body);
// Bodies are drawn anew when more of them has been severed.
void redrawDamage(WorldImpl& w);

// Those of the scene as they are now, then those that were added.
ForceList forcesOf(const WorldImpl& w);

}  // namespace taut::world
