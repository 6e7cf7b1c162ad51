// Whether the cells of blocks that are made of meshes are fine enough for these, and whether the meshes cross
// themselves.
#pragma once

#include <vector>

#include "taut/core/finding.h"

namespace taut::world {

struct SceneSpec;

// Of each block with a mesh: parts that are thinner than a cell, with cells that would do; and where faces go through
// each other, or parts lie in each other.
std::vector<core::Finding> meshCellDoubts(const SceneSpec& scene);

}  // namespace taut::world
