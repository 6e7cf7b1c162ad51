// Stretch moduli of a sheet of springs as a continuum.
#pragma once

#include "taut/mechanics/model.h"

namespace taut::mechanics {

// Of a strip that is cut at some angle to the warp and drawn along its length.
struct StripModuli {
    double young = 0;    // [N/m] force per metre of width over strain
    double poisson = 0;  // cross contraction over strain
};

// The stiffness of an orthotropic sheet, per metre of width: (σ_u, σ_v, τ) = C (ε_u, ε_v, γ).
struct SheetStiffness {
    double c11 = 0, c22 = 0, c12 = 0,
           c66 = 0;  // [N/m]; C12 = C66 in every sheet of springs between neighbours (Cauchy)

    StripModuli at(double angle) const;  // [rad] from the warp. {0, 0} where the sheet does not resist.
};

// The mean over a body, of its springs except bending springs, strained alike everywhere: Σ k L² n⊗n⊗n⊗n / area, where
// n is a spring's direction in the material, from Model::grain on. Exact for grids, except for additional couplings of
// a grain between multiples of 45°; an upper bound for a mesh, whose points give way. A mesh that is not laid flat by
// its texture coordinates has springs in all directions alike. All 0 for a body without an area.
SheetStiffness sheetStiffness(const Model& model);

}  // namespace taut::mechanics
