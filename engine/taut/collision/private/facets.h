// Triangles as they bound a solid, or a sheet: checked, their repeated vertices joined, the outside found.
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

struct Facets {
    std::vector<Facet> triangles;        // none without area
    std::vector<std::uint32_t> corners;  // (3 · triangles) vertices; those at one place are the same
    std::vector<bool> isBorder;          // (vertices) an edge that has not a triangle on either side ends here
    bool isClosed = false;               // it has no border; then triangles show their front to the outside
};

// Throws core::Error(badContent) for a mesh without triangles of non-zero area, an index out of range, or more than two
// million triangles.
Facets makeFacets(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles);

}  // namespace taut::collision
