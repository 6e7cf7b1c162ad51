// A layer with the motion of each pixel's middle to the next frame.
#pragma once

#include <memory>

#include "taut/render/layer_table.h"

namespace taut::render {

// Three numbers of 16 bits, as the KITTI benchmark has them (Menze and Geiger 2015): 32768 + 64 times the motion to the
// right and down [px], and 1. All 0 where it is unknown: above 511 px, behind the next camera, in the last view, and
// where a surface has other triangles in the next view. Motion is exact: that of the same place of a triangle's next
// vertices, and of ground and sky that of the camera. Rims of hems move with their cloth.
std::shared_ptr<const Layer> flowLayer();

}  // namespace taut::render
