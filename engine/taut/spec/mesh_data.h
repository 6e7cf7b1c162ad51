// What an OBJ file holds.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "taut/spec/source.h"

namespace taut::world {

// What an OBJ file holds, before scale, rotation and position: vertices welded by position, each used by a triangle.
struct MeshData {
    std::vector<dvec3> positions;                    // (vertices) in the file's unit
    std::vector<dvec2> uv;                           // (vertices) as in the file, or empty if a corner has none
    std::vector<std::array<int, 3>> triangles;       // (triangles) indices of vertices, in the file's orientation
    std::map<std::string, std::vector<int>> groups;  // vertices by the file's g and o, ascending
    // What the file calls them: vertices from 1, triangles by the line of their face.
    std::vector<int> numbers, lines;
};

// A mesh file that a body or a collider is made from.
struct MeshSource {
    std::string mesh;                          // path, resolved by the loader; empty: none
    std::shared_ptr<const MeshData> meshData;  // what the file holds; null: none
};

}  // namespace taut::world
