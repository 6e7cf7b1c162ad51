#include "taut/pipeline/frame_ahead.h"

#include <utility>

#include "taut/world/world.h"

namespace taut::pipeline {

FrameAhead frameAhead(std::function<world::World()> makeWorld) {
    return [makeWorld = std::move(makeWorld), ahead = std::shared_ptr<world::World>()](
               const world::World& world) mutable -> std::shared_ptr<const view::FrameView> {
        if (!ahead || ahead->tick() != world.tick()) {
            ahead = std::make_shared<world::World>(makeWorld());
            ahead->restore(world.save());
        }
        for (const std::int64_t goal = world.tick() + world.ticksPerFrame(); ahead->tick() < goal;) {
            if (!ahead->advance()) continue;
            ahead.reset();
            return nullptr;
        }
        return std::make_shared<const view::FrameView>(ahead->view(false));
    };
}

}  // namespace taut::pipeline
