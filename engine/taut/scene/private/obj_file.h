// Reads the triangles and groups of a Wavefront OBJ file. It knows no materials, normals, curves or lines and leaves
// them out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "taut/spec/mesh_data.h"

namespace taut::scene {

// The file's faces as triangles: polygons cut in a fixed way (polygon.h), vertices at the same position made one,
// unused ones dropped, triangles that thereby lose their area dropped. A vertex takes the texture coordinates of the
// first corner that uses it, and belongs to every group (g) and object (o) with a face at it. Same bits on every
// machine. Throws core::Error: inputOutput if the file cannot be read, badContent ("file:line: error: …") for numbers
// that are none or not finite, indices out of range, faces of fewer than three corners, and a file without faces.
world::MeshData objMesh(const std::filesystem::path& path);

// The same for a text; fileName is used in messages.
world::MeshData objMeshText(std::string_view text, const std::string& fileName);

}  // namespace taut::scene
