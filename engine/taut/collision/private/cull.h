// Loops over whole blocks of points that find which points may touch at all. They know only boxes and planes.
#pragma once

#include <cstdint>

#include "taut/collision/geometry.h"

namespace taut::collision {

// [-] Some times the rounding of a coordinate of 1 m: the state is rounded, and so are the frames it is taken through.
template <class Real>
constexpr double skinPerMetre = sizeof(Real) == sizeof(float) ? 4.8e-7 : 4e-15;

// The planes of one block: six rows, x y z of the start and x y z of the end of the step.
template <class Real>
struct BlockRows {
    const Real* before[3];
    const Real* after[3];
    int count = 0;
};

// The box of all paths. A coordinate that is not a number is ignored.
template <class Real>
core::Aabb boundsOf(const BlockRows<Real>& rows);

// Sets `bit` in the mask of every point whose path's box overlaps the given box.
template <class Real>
void markNearBox(const BlockRows<Real>& rows, const core::Aabb& box, std::uint32_t bit, std::uint32_t* mask);

// Sets `bit` in the mask of every point whose end is lower than `height` [m] over the plane normal · x = offset.
template <class Real>
void markUnderPlane(const BlockRows<Real>& rows, const dvec3& normal, double offset, double height, std::uint32_t bit,
                    std::uint32_t* mask);

}  // namespace taut::collision
