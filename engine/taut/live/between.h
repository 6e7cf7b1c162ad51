// A picture between two ticks. It is for display only and never goes back into the state.
#pragma once

#include "taut/view/frame_view.h"

namespace taut::live {

// `share` 0 is `before`, 1 is `now`. Parts without a counterpart in `before` (a new body, a torn cloth) come from
// `now`, and so do labels. Debug marks are blended if both have the same number.
view::FrameView between(const view::FrameView& before, const view::FrameView& now, double share);

}  // namespace taut::live
