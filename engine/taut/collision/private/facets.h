// The triangles that bound a solid or form a sheet. They are checked, repeated vertices are joined, and the outside is
// found.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "taut/collision/geometry.h"

namespace taut::collision {

struct Facet {
    dvec3 corner, ab, ac;  // [m]
    dvec3 normal;          // unit, along ab × ac
};
static_assert(sizeof(Facet) == 12 * sizeof(double));  // the kernels take it for an array

struct Facets {
    std::vector<Facet> triangles;        // none without area
    std::vector<std::uint32_t> corners;  // (3 · triangles) vertices; two at one place have the same number
    std::vector<bool> isBorder;          // (vertices) an edge without a triangle on each side ends here
    bool isClosed = false;               // there is no border; then the triangles' fronts face outwards
};

// Throws core::Error(badContent) for a mesh without triangles of non-zero area, an index out of range, or more than two
// million triangles.
Facets makeFacets(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles);

}  // namespace taut::collision
