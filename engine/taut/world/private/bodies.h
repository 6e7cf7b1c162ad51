// How bodies come into a world, each with an island of its own, and leave it; and which forces act on them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "taut/body/body.h"
#include "taut/ecs/entity.h"
#include "taut/forces/force.h"

namespace taut::world {

class Island;
struct WorldImpl;

// Adds the bodies of the scene and ties them by its joints. Bodies that an action will spawn wait.
void addBodies(WorldImpl& w);
// Adds a body as an island of its own.
ecs::Entity spawn(WorldImpl& w, Body body);
// Returns whether any body of that name was waiting.
bool spawnWaiting(WorldImpl& w, const std::string& target);
// Removes a body that is alone in its island from all that knows it, but keeps the entity.
void removeBody(WorldImpl& w, ecs::Entity entity);

std::vector<Body*> bodiesOf(const WorldImpl& w);  // in the order of the state hash
Island& islandOf(const Body& body);
// Draws bodies anew whose damage has grown.
void redrawDamage(WorldImpl& w);

// The forces of the scene in its present state, followed by the added ones.
ForceList forcesOf(const WorldImpl& w);

}  // namespace taut::world
