#include "taut/view/frame_view.h"

namespace taut::view {

TAUT_VALUE_MEMBERS(FrameView);

}  // namespace taut::view
