// Closed meshes of boxes.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace taut::mechanics::test {

using glm::dvec3;

struct Mesh {
    std::vector<dvec3> positions;
    std::vector<std::array<int, 3>> triangles;
};

// A box from low to high; turned inwards, it is a hollow.
inline void addBox(Mesh& mesh, const dvec3& low, const dvec3& high, bool isHollow = false) {
    const int first = static_cast<int>(mesh.positions.size());
    for (int c = 0; c < 8; ++c)
        mesh.positions.emplace_back(c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z);
    for (int axis = 0; axis < 3; ++axis)
        for (int end = 0; end < 2; ++end) {
            const int x = 1 << axis, y = 1 << (axis + 1) % 3, z = 1 << (axis + 2) % 3, at = first + end * x;
            std::array<std::array<int, 3>, 2> faces{{{at, at + y, at + y + z}, {at, at + y + z, at + z}}};
            for (auto& t : faces) {
                if ((end == 0) != isHollow) std::swap(t[1], t[2]);
                mesh.triangles.push_back(t);
            }
        }
}

}  // namespace taut::mechanics::test
