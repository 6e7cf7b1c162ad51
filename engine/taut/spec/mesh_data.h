// Contents of a mesh file.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "taut/core/value.h"
#include "taut/figure/figure.h"
#include "taut/spec/source.h"

namespace taut::world {

// Contents of a mesh file, before scale, rotation and position. Vertices are welded by position; a triangle uses each.
struct MeshData {
    TAUT_VALUE(MeshData);
    std::vector<dvec3> positions;                    // (vertices) in the file's unit
    std::vector<dvec2> uv;                           // (vertices) as in the file, or empty if a corner has none
    std::vector<std::array<int, 3>> triangles;       // (triangles) indices of vertices, oriented as in the file
    std::vector<std::array<dvec2, 3>> cornerUv;      // (triangles) uv of their corners, also at seams; or empty as uv
    std::map<std::string, std::vector<int>> groups;  // vertices by name
    // Numbers in the file: vertices count from 1, triangles have the line of their face.
    std::vector<int> numbers, lines;

    // Of a glTF file: the animation of these vertices, which are here in the rest pose of the file.
    std::shared_ptr<const figure::Figure> figure;  // null: nothing
    std::uint64_t hash = 0;                        // of all bytes that were read
    std::vector<std::string> files;                // paths of further files that it names
    std::vector<std::string> notes;                // ignored parts of the file
};

// The mesh file of a body or a collider.
struct MeshSource {
    std::string mesh;                          // path, resolved by the loader; empty: none
    std::shared_ptr<const MeshData> meshData;  // content of the file, or mesh of an outline; null: none
};

// "cannot use this mesh: file:line: error: fault", with the line of the triangle, if there is one.
std::string meshFaultText(const MeshSource& source, const std::string& what, int triangle);

}  // namespace taut::world
