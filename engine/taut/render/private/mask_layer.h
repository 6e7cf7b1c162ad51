// A layer with a flat colour for each thing, without smooth edges: which of them is seen in a pixel.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "taut/render/layer_table.h"

namespace taut::render {

// `colours`: 0xRRGGBB by the name of a surface; others are black, like ground and sky.
std::shared_ptr<const Layer> maskLayer(std::map<std::string, std::uint32_t> colours);

}  // namespace taut::render
