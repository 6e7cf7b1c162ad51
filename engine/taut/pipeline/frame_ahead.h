// The view of the next frame while a run shows the present one.
#pragma once

#include <functional>
#include <memory>

#include "taut/view/frame_view.h"

namespace taut::world {
class World;
}

namespace taut::pipeline {

using FrameAhead = std::function<std::shared_ptr<const view::FrameView>(const world::World&)>;

// A second world of the same scene plays a frame ahead, from the state of the first. The view depends on that state
// alone, also after the last frame of a part. Null if the second world diverges. `makeWorld` is called at the first
// view, and again if the moments of two views are not a frame apart.
FrameAhead frameAhead(std::function<world::World()> makeWorld);

}  // namespace taut::pipeline
