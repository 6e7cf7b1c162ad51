// A layer with the depth of the picture, in integer units.
#pragma once

#include <memory>

#include "taut/render/layer_table.h"

namespace taut::render {

// Numbers of `unit` [m] ahead of the eye along the camera's axis, rounded; image::farDepth where only the sky is
// visible, one less for greater depths. The ground is visible as far as it is drawn.
std::shared_ptr<const Layer> depthLayer(double unit);

}  // namespace taut::render
