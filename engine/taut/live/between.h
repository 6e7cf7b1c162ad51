// A picture between two ticks. For the eye alone: nothing of it goes back into the state.
#pragma once

#include "taut/view/frame_view.h"

namespace taut::live {

// `share` 0 is `before`, 1 is `now`. What has no counterpart in `before` (a body that came into being, a cloth that
// tore) is as it is in `now`, labels too; marks of debugging are blended where there are as many.
view::FrameView between(const view::FrameView& before, const view::FrameView& now, double share);

}  // namespace taut::live
