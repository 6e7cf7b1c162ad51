// How much a scene will hold once it is built, so that too much is refused before anything is allocated.
#pragma once

#include "taut/world/spec.h"

namespace taut::scene {

// Counts as doubles: they may be far beyond any integer.
struct BodySize {
    double points = 0, springs = 0, volumes = 0;  // of all copies
    double bytes() const;                         // of the model and the state, roughly
};

BodySize sizeOf(const world::BodySpec& body, const world::SceneSpec& scene);
BodySize sizeOf(const world::SceneSpec& scene);  // of all bodies together

// Half of the machine's memory [bytes].
double memoryLimit();

inline constexpr double maxPoints = 50e6;

}  // namespace taut::scene
