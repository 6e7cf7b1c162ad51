// Whether a place is inside of a closed mesh, by the triangles over it: the mesh goes round it at least once. Places
// are counted in cubes of a box; each column has a list of the triangles that cross it.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace taut::world {

class Inside {
  public:
    Inside(std::vector<glm::dvec3> places, std::span<const std::array<int, 3>> triangles, glm::ivec2 columns);
    bool has(const glm::dvec3& place) const;

  private:
    glm::ivec2 columnAt(const glm::dvec3& place) const;
    std::size_t numberOf(glm::ivec2 column) const;

    std::vector<glm::dvec3> places_;
    glm::ivec2 counts_;
    std::vector<std::vector<std::array<int, 3>>> columns_;  // triangles
};

}  // namespace taut::world
