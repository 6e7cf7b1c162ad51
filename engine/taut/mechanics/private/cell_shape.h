// The geometry of a tetrahedron, from which its stiffness is computed.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

#include "taut/mechanics/model.h"

namespace taut::mechanics {

using CellCorners = std::array<glm::dvec3, 4>;  // [m]

// The corners of a cell, from planes of points.
template <class Real>
CellCorners cornersOf(const VolumeCell& cell, const Real* planes, std::ptrdiff_t stride) {
    CellCorners p;
    for (std::size_t c = 0; c < 4; ++c) {
        const std::ptrdiff_t i = cell.points[c];
        p[c] = {planes[i], planes[i + stride], planes[i + 2 * stride]};
    }
    return p;
}

inline double volumeOf(const CellCorners& p) {
    return glm::dot(p[1] - p[0], glm::cross(p[2] - p[0], p[3] - p[0])) / 6.0;
}

// ∂V/∂p [m²] of each corner.
inline CellCorners gradientsOf(const CellCorners& p) {
    const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0], e3 = p[3] - p[0];
    const glm::dvec3 g1 = glm::cross(e2, e3) / 6.0, g2 = glm::cross(e3, e1) / 6.0, g3 = glm::cross(e1, e2) / 6.0;
    return {-(g1 + g2 + g3), g1, g2, g3};
}

// Edges i–j. k and l are the other two corners, such that (i, j, k, l) is an even permutation. Then
// (∂²V/∂p_i∂p_j) u = h × u with h = (p_k - p_l)/6.
struct CellEdge {
    std::size_t i, j, k, l;
};
inline constexpr std::array<CellEdge, 6> cellEdges = {
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

}  // namespace taut::mechanics
