// Reads the meshes, skins and animations of a glTF file, binary or text.
#pragma once

#include <filesystem>
#include <string>

#include "taut/scene/private/text_file.h"
#include "taut/spec/mesh_data.h"

namespace taut::scene {

// The file's default scene in its rest pose, and its figure. Vertices of a node at the same position are merged, and
// triangles that lose their area are dropped. The notes of the mesh list the ignored parts of the file. Other files
// that it names must be allowed. Throws core::Error: inputOutput if a file cannot be read; badContent ("file: error:
// …") for anything that breaks the format, in the words of glTF, for numbers that are not finite, a file without
// triangles, and required extensions that are not supported.
world::MeshData gltfMesh(const std::filesystem::path& path, const Confinement& confinement);

// The same for the contents of such a file; the path appears in messages, and other files lie beside it.
world::MeshData gltfMeshText(std::string bytes, const std::filesystem::path& path, const Confinement& confinement);

}  // namespace taut::scene
