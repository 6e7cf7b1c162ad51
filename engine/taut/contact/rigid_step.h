// A step for all solids of a cluster at once. Sweeps pass an impulse on by one layer of a pile each; what they leave of
// a pile at rest, it leans by. The impulses between solids, and between them and what nothing moves, become those with
// which the energy
//
//     ½ δ·M δ + ½ Σ k min(n·u, 0)² + ½ Σ k |t·u|²         u = J (velocities without these impulses + δ) + closing n
//
// of the change δ of their velocities is least: λ = -k u, with k a million effective masses of the row, so that rows
// that say the same twice share their impulse. The second sum goes over rows that stick. It is least after some steps
// of Newton's method, each along the least of the energy (six unknowns a solid, ordered after Cuthill and McKee 1969,
// by Cholesky's method within the envelope). Rows that then do not press, or are beyond the cone of friction, slide:
// they keep the friction at its edge, and the rest is done again.
//
// Of the whole change that share is applied for which the energy of the motion is least (solver.h), so that a step
// lowers it or does nothing, as sweeps do. It knows nothing of points that are no solid's: rows with them stay as they
// are.
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

// Changes impulses of rows, and velocities. solids: all that are in rows, ascending by slot. Returns whether it did so:
// not if that would be dearer than many sweeps.
bool stepRigidly(std::span<Row> rows, std::span<const RigidSlots> solids, const Levers& levers,
                 std::span<Four> velocities);

}  // namespace taut::contact
