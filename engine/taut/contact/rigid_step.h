// A step for all solids of a cluster at once, where sweeps pass an impulse on by one layer of a pile each.
//
// Rows that press between solids, or between a solid and what nothing moves, are taken as equations: they close no
// further, and where friction is inside its cone they do not slide. Their impulses change by
//
//     Δλ = -k (J (u + δ) + c),   (M + Jᵀ k J) δ = -Jᵀ k (J u + c)         k: 1e5 effective masses of the row
//
// for the change δ of the solids' velocities: six unknowns a solid, ordered after Cuthill and McKee 1969, solved by
// Cholesky's method within the envelope. As k is finite, rows that say the same twice share their impulse. Rows that would
// pull are left out and the rest is solved again. Of the whole change that share is applied for which the energy of
// the motion is least, so that a step lowers it or does nothing, as sweeps do.
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

// Changes impulses of rows and velocities. solids: that move and are in a row, ascending by slot. Returns whether it
// lowered the energy.
bool stepRigidly(std::span<Row> rows, std::span<const RigidSlots> solids, std::span<const Turn> turns,
                 std::span<Four> velocities);

}  // namespace taut::contact
