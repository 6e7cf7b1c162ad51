// The mesh from which a block is made, before anything moves, and made finer.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace taut::world {

struct PlacedMesh {
    std::vector<glm::dvec3> places;  // (vertices) [m]
    std::vector<glm::dvec2> uv;      // (vertices)
    std::vector<std::array<int, 3>> triangles;
};

// Halves edges that are longer than this [m] of triangles that are wanted until there are none. Triangles beside them
// are split too, also where vertices are several in one place.
void refine(PlacedMesh& mesh, double longest, const std::function<bool(const std::array<int, 3>&)>& isWanted);

}  // namespace taut::world
