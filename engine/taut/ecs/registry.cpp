#include "taut/ecs/registry.h"

namespace taut::ecs {

Entity Registry::create() {
    std::uint32_t index = 0;
    if (free_.empty()) {
        index = static_cast<std::uint32_t>(generations_.size());
        generations_.push_back(0);
    } else {
        index = free_.back();
        free_.pop_back();
    }
    ++alive_;
    return {index, ++generations_[index]};
}

void Registry::destroy(Entity entity) {
    TAUT_EXPECTS(isAlive(entity));
    for (auto& [type, pool] : pools_) pool->erase(entity);
    ++generations_[entity.index];
    free_.push_back(entity.index);
    --alive_;
}

bool Registry::isAlive(Entity entity) const {
    return entity.index < generations_.size() && generations_[entity.index] == entity.generation &&
           (entity.generation & 1U) != 0;
}

}  // namespace taut::ecs
