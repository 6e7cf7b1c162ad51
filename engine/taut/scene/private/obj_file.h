// Reads the triangles and groups of a Wavefront OBJ file. It ignores materials, normals and curves.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "taut/spec/mesh_data.h"

namespace taut::scene {

// The file's faces as triangles. Polygons are cut in a fixed way (polygon.h). Vertices at the same position are merged,
// unused ones dropped, and so are triangles that lose their area by this. A vertex has the texture coordinates of the
// first corner that uses it, and belongs to every group (g) and object (o) with a face at it. A group of
// lines (l) alone has the vertices of these, or none if one of them is at no face. Same bits on every machine. Throws
// core::Error: inputOutput if the file cannot be read; badContent
// ("file:line: error: …") for bad or infinite numbers, indices out of range, faces of fewer than three corners, and a
// file without faces.
world::MeshData objMesh(const std::filesystem::path& path);

// The same for a text; fileName appears in messages.
world::MeshData objMeshText(std::string_view text, const std::string& fileName);

}  // namespace taut::scene
