#include "taut/scene/private/gltf_file.h"

#include <memory>
#include <utility>

#include "taut/core/whole_file.h"
#include "taut/figure/figure.h"
#include "taut/scene/private/gltf_meshes.h"
#include "taut/scene/private/gltf_model.h"
#include "taut/scene/private/gltf_nodes.h"

namespace taut::scene {

namespace {

void noteIgnored(GltfModel& gltf) {
    const tinygltf::Model& content = gltf.content();
    if (!content.cameras.empty()) gltf.note(fmt::format("{} camera(s)", content.cameras.size()));
    if (!content.lights.empty()) gltf.note(fmt::format("{} light(s)", content.lights.size()));
    for (const std::string& extension : content.extensionsUsed)
        if (extension != "KHR_mesh_quantization") gltf.note(extension);
}

}  // namespace

world::MeshData gltfMesh(const std::filesystem::path& path, const Confinement& confinement) {
    return gltfMeshText(core::fileContent(path, GltfModel::maxFileSize), path, confinement);
}

world::MeshData gltfMeshText(std::string bytes, const std::filesystem::path& path, const Confinement& confinement) {
    GltfModel gltf(std::move(bytes), path, confinement);
    const auto figure = std::make_shared<figure::Figure>();
    const GltfNodes nodes = readGltfNodes(gltf, *figure);
    readGltfSkins(gltf, nodes, *figure);
    world::MeshData mesh = readGltfMeshes(gltf, nodes, *figure);
    readGltfAnimations(gltf, nodes, *figure);
    noteIgnored(gltf);
    mesh.figure = figure;
    mesh.hash = gltf.hash();
    mesh.files = gltf.files();
    mesh.notes.assign(gltf.notes().begin(), gltf.notes().end());
    return mesh;
}

}  // namespace taut::scene
