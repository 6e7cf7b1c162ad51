// The meshes of a glTF file: merged vertices, skin weights, morph targets and materials.
#pragma once

#include "taut/figure/figure.h"
#include "taut/scene/private/gltf_model.h"
#include "taut/scene/private/gltf_nodes.h"
#include "taut/spec/mesh_data.h"

namespace taut::scene {

// Adds the meshes of drawn nodes to the figure, whose skins are there. Returns the mesh in the rest pose, without its
// figure.
world::MeshData readGltfMeshes(GltfModel& gltf, const GltfNodes& nodes, figure::Figure& figure);

}  // namespace taut::scene
