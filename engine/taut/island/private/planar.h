// Vectors of points that are stored in planes x…x y…y z…z.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "taut/core/aligned_array.h"

namespace taut::world {

template <class Real>
struct Planar {
    int stride = 0;

    std::size_t index(int point, int plane) const {
        return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(plane) * stride + point);
    }
    glm::dvec3 at(const core::AlignedArray<Real>& planes, int point) const {
        return {static_cast<double>(planes[index(point, 0)]), static_cast<double>(planes[index(point, 1)]),
                static_cast<double>(planes[index(point, 2)])};
    }
    void set(core::AlignedArray<Real>& planes, int point, const glm::dvec3& value) const {
        for (int p = 0; p < 3; ++p) planes[index(point, p)] = static_cast<Real>(value[p]);
    }
};

}  // namespace taut::world
