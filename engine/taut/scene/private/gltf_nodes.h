// The nodes, skins and animations of a glTF file, as parts of a figure.
#pragma once

#include <vector>

#include "taut/figure/figure.h"
#include "taut/scene/private/gltf_model.h"

namespace taut::scene {

struct GltfNodes {
    std::vector<bool> isDrawn;  // (nodes of the file) in its scene
    std::vector<int> numberOf;  // (nodes of the file) in the figure
};

// Parents before their children. Nodes outside of the scene are read, since joints may be there, but not drawn.
GltfNodes readGltfNodes(const GltfModel& gltf, figure::Figure& figure);
void readGltfSkins(const GltfModel& gltf, const GltfNodes& nodes, figure::Figure& figure);
// Expects the meshes, which give nodes their weights.
void readGltfAnimations(GltfModel& gltf, const GltfNodes& nodes, figure::Figure& figure);

}  // namespace taut::scene
