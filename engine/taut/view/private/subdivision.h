// A smooth surface that the vertices of a mesh control, as a finer mesh: every vertex of that is a sum of vertices
// of the mesh with weights that never change. It knows no cloth.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "taut/view/frame_view.h"

namespace taut::view {

// Counter-clockwise; a triangle has noVertex last.
using Face = std::array<std::uint32_t, 4>;
inline constexpr std::uint32_t noVertex = ~0U;

// Of a matrix that is mostly zero.
struct SparseRows {
    struct Term {
        std::uint32_t column;
        glm::vec3 weights;  // of a place, and of two tangents there
    };
    std::vector<std::size_t> first{0};  // (rows + 1) terms of row r are terms[first[r]] … terms[first[r + 1] - 1]
    std::vector<Term> terms;
    std::size_t count() const { return first.size() - 1; }
};

struct FineMesh {
    std::vector<std::uint32_t> triangles;  // (3 · triangles)
    SparseRows controls;  // of vertices of the mesh: control points of a surface that passes close to them
    SparseRows surface;   // of controls: vertices on the surface
    // (vertices beyond those of the mesh) Two earlier vertices, between which each is on the mesh as that is, flat.
    std::vector<std::array<std::uint32_t, 2>> middles;

    // Expects a position, or uv, of every vertex of the mesh. No place of the surface is `room` [m] (> 0) or more from
    // its place on the flat mesh: it nears that without a kink.
    Geometry geometry(std::span<const glm::vec3> positions, float room) const;
    std::vector<glm::vec2> spread(std::span<const glm::vec2> uv) const;
};

// The mesh split `levels` times (>= 1), its vertices and normals on the surface itself. The first of its vertices are
// those of the mesh. rest (vertices) [m] says where the border has corners, if it keeps any: in one face alone, or
// where it turns by more than 60 degrees; these stay where they are, as do those in `kept`.
FineMesh subdivided(std::vector<Face> faces, std::span<const glm::dvec3> rest, bool keepsCorners, int levels,
                    std::span<const std::uint32_t> kept = {});

}  // namespace taut::view
