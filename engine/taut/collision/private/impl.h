// The data of Colliders: all solids in one row, in the order in which they were added.
#pragma once

#include <vector>

#include "taut/collision/private/solid.h"

namespace taut::collision {

struct Colliders::Impl {
    std::vector<Solid> solids;
    std::vector<std::size_t> firstSolid{0};  // (colliders + 1) of each collider
    std::shared_ptr<const char> identity = std::make_shared<const char>();  // of these colliders and their clones
};

}  // namespace taut::collision
