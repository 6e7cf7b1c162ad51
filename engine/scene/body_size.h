// How much a body will hold once it is built, from the numbers in its spec, so that too much is refused before
// anything is allocated.
#pragma once

#include "taut/world/spec.h"

namespace taut::scene {

// Counts as doubles: they may be far beyond any integer.
struct BodySize {
    double points = 0, springs = 0, cells = 0;  // of all copies
    double pointsOfOne = 0;                     // of one copy
    double bytes() const;                       // of the model and the state, roughly
};

BodySize sizeOf(const world::ClothSpec& cloth);
BodySize sizeOf(const world::RopeSpec& rope);
BodySize sizeOf(const world::BlockSpec& block);
BodySize sizeOf(const world::NetSpec& net);
BodySize sizeOf(const world::SceneSpec& scene);  // of all bodies together

// Half of the machine's memory [bytes].
double memoryLimit();

inline constexpr double maxPoints = 50e6;

}  // namespace taut::scene
