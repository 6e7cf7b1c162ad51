// Layers with properties of the surface under the middle of each pixel: its normal, and its colour without light.
#pragma once

#include <memory>

#include "taut/render/layer_table.h"

namespace taut::render {

// Three numbers of 16 bits, 0 where there is no surface. Normals point to the side that is seen: 32767.5 + 32767.5 x,
// y, z, in the axes of the scene.
std::shared_ptr<const Layer> normalsLayer();
// sRGB, without weave.
std::shared_ptr<const Layer> albedoLayer();

}  // namespace taut::render
