// The hand-over from simulation to pictures.
#pragma once

#include "taut/view/frame_view.h"

namespace taut::world {

struct WorldImpl;

// As World::view() and World::viewAhead().
view::FrameView viewOf(WorldImpl& w, bool debug);
view::FrameView viewAhead(const WorldImpl& w, double ahead);
// The one that draws pictures, at a time [s], `ahead` [s] of the tick.
view::Camera cameraOfPictures(const WorldImpl& w, double time, double ahead = 0.0);

}  // namespace taut::world
