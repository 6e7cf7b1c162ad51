// Middles of targets and lengths, for tests of joints at places.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "taut/world/world.h"

namespace taut::world {

inline double lengthOf(const dvec3& d) {
    return std::sqrt(glm::dot(d, d));
}

// [m] Of the points of a target, each with the same weight.
inline dvec3 middle(const World& world, const std::string& target) {
    dvec3 sum(0.0);
    const std::vector<dvec3> x = world.points(target).x;
    for (const dvec3& own : x) sum += own;
    return sum / static_cast<double>(x.size());
}

}  // namespace taut::world
