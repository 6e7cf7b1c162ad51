// A layer of how far away what a picture shows lies, as whole units.
#pragma once

#include <memory>

#include "taut/render/layer_table.h"

namespace taut::render {

// Numbers of `unit` [m] ahead of the eye along the camera's axis, rounded; image::farDepth where only the sky is seen,
// one less for what lies farther than that. The ground is seen as far as it is drawn.
std::shared_ptr<const Layer> depthLayer(double unit);

}  // namespace taut::render
