// How far points could still go that are nearly at rest on the springs that hold them.
#pragma once

#include <span>

#include "taut/mechanics/private/stability.h"

namespace taut::world {

using glm::dvec3;

// [m] The way of the point that could go furthest, to first order:
//
//     |K⁻¹ r|  +  max|v| sqrt(p·K⁻¹p / p·v)        r = m (a + drag v)  residual force,  p = m v
//
// K is the stiffness of the free points with all others held, and with points that something presses held along that
// only. The first term is the way to where the forces balance. The second is the amplitude of a swing: each mode k goes
// v_k / ω_k, so p·K⁻¹p is the mass times the mean square of the amplitude, exact over all points and modes; from the
// mean to the furthest point it takes the share that the velocities have. Both use the motion that there is, so they
// are no larger than |r| / λ + sqrt(2 KE / λ) with the smallest eigenvalue λ, which a method would have to find first.
//
// Infinite if K does not hold the points: it is not positive definite, or the conjugate gradients do not converge. A
// velocity of `floor` [m/s] in all directions is added to v, so that a motion without any restoring force is found even
// at rest. (points) inverseMasses [1/kg], 0 where held; normals: unit, along which something presses, or 0; v [m/s]; r
// [N]. multiply: adds K u.
double restBound(std::span<const double> inverseMasses, std::span<const dvec3> normals, std::span<const dvec3> v,
                 std::span<const dvec3> r, double floor, const mechanics::StiffnessProduct& multiply);

}  // namespace taut::world
