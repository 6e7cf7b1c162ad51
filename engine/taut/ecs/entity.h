// The name of who exists. It knows no component; the registry has those.
#pragma once

#include <cstdint>

namespace taut::ecs {

struct Entity {
    std::uint32_t index = 0;
    std::uint32_t generation = 0;  // tells an entity from a later one in the same place
    friend bool operator==(const Entity&, const Entity&) = default;
};

}  // namespace taut::ecs
