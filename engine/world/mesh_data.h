// What an OBJ file holds.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "taut/world/source.h"

namespace taut::world {

// What an OBJ file holds, before scale, rotation and position: vertices welded by position, each used by a triangle.
struct MeshData {
    std::vector<dvec3> positions;               // (vertices) in the file's unit
    std::vector<dvec2> uv;                      // (vertices) as in the file, or empty if a corner has none
    std::vector<std::array<int, 3>> triangles;  // (triangles) indices of vertices, in the file's orientation
};

// A mesh file that a body or a collider is made from.
struct MeshSource {
    std::string mesh;                          // path, resolved by the loader; empty: none
    std::shared_ptr<const MeshData> meshData;  // what the file holds; null: none
};

}  // namespace taut::world
