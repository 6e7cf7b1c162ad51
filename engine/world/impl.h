// What a world is made of, shared by its sources only.
#pragma once

#include <optional>

#include "core/parallel.h"
#include "world/components.h"
#include "world/island.h"
#include "world/world.h"

namespace taut::world {

struct World::Impl {
    SceneSpec spec;
    core::ThreadLimit threads;
    ecs::Registry registry;
    std::vector<System> systems;
    std::vector<std::unique_ptr<Island>> islands;
    std::vector<ecs::Entity> bodies;  // sorted by kind and name
    double ticksPerSecond = 60;
    int ticksPerFrame = 1;
    std::int64_t tick = 0;
    std::uint64_t hash = 0;

    Impl(const SceneSpec& scene, const Options& options);

    TickTime now() const { return {tick, ticksPerSecond}; }
    double seconds() const { return static_cast<double>(tick) / ticksPerSecond; }

    void addBodies();
    void addIsland(IslandPlan plan);
    IslandForces forces();
    void rebuildColliders();
    ecs::Entity addCollider(const ColliderSpec& collider);
    ecs::Entity addBody(std::unique_ptr<Body> body);
    ecs::Entity spawn(Body body);
    void placeColliders();
    std::vector<ColliderMotion> movingColliders();
    void undoTick();
    void updateHash();
    Island& islandOf(const Body& body) const;
};

}  // namespace taut::world
