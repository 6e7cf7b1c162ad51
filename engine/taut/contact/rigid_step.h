// The impulses of a cluster's solids, all at once. Sweeps pass an impulse on by one layer of a pile each; what they
// leave of a pile at rest, it leans by. Here the impulses between solids, and between them and what nothing moves,
// become those for which the energy of the motion is least, each in its cone of friction:
//
//     M δ = Jᵀ λ,  u = J (velocities without these impulses + δ) + closing n,     |λt| <= μ λn,  μ |ut| <= un,  λ·u = 0
//
// That is a quadratic problem on cones of second order, as Anitescu and Tasora 2010 state contact. It is solved by an
// interior point method with the scaling of Nesterov and Todd 1997 and the steps of Mehrotra 1992 (Vandenberghe 2010,
// "The CVXOPT linear and quadratic cone program solvers"): some twelve steps, whatever the pile. Each is one Cholesky
// factorisation of M + Jᵀ W⁻² J, which has six unknowns a solid, ordered after Cuthill and McKee 1969.
//
// Joints are stiff springs between velocities there.
//
// In it what slides at a speed parts at μ times that speed, so it is for what is near rest; the sweeps that follow
// put that right. Of the whole change that share is applied for which the energy of the motion is least (solver.h),
// so that a step lowers it or does nothing, as sweeps do. It knows nothing of points that are no solid's: rows with
// them stay as they are.
#pragma once

#include <glm/mat3x3.hpp>
#include <span>

#include "taut/contact/gauss_seidel.h"

namespace taut::contact {

// A solid of the step.
struct RigidSlots {
    int slot;            // of its velocity; then comes that of its spin
    double mass;         // [kg]
    glm::dmat3 inertia;  // [kg m²]
};

// Changes impulses of rows, and velocities, until rows are wrong by about `tolerance` [m/s]. solids: all that are in
// rows, ascending by slot. It does nothing if that would be dearer than many sweeps.
void stepRigidly(std::span<Row> rows, std::span<const RigidSlots> solids, const Levers& levers, double tolerance,
                 std::span<Four> velocities);

}  // namespace taut::contact
