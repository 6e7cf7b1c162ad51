// Scenes written in code: the start of several tests of the world.
#pragma once

#include <string>
#include <vector>

#include "taut/spec/spec.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::test {

using glm::dvec3;

// Double precision, one tick of `tick` seconds, one step a tick unless the limit asks for more.
inline world::SceneSpec exactScene(double tick, std::string method = "leapfrog") {
    world::SceneSpec scene;
    scene.solver.precision = world::Precision::double_;
    scene.solver.integrator = std::move(method);
    scene.solver.dt = tick;
    scene.run.fps = 1.0 / tick;
    return scene;
}

// The first body of that name in the world.
inline ecs::Entity bodyOf(world::World& world, const std::string& name) {
    ecs::Entity found{};
    world.registry().each<world::Identity>([&](ecs::Entity entity, const world::Identity& identity) {
        if (identity.fullName() == name) found = entity;
    });
    return found;
}

inline std::vector<dvec3> positionsOf(world::World& world, const std::string& name) {
    return world.positions(bodyOf(world, name));
}

// Advances until the ticks are done or the world diverges.
inline std::optional<world::Divergence> advance(world::World& world, int ticks) {
    for (int i = 0; i < ticks; ++i)
        if (auto divergence = world.advance()) return divergence;
    return std::nullopt;
}

}  // namespace taut::test
