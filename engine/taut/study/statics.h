// Where a model comes to rest under gravity. It knows springs, held points and weight; no wind, contact or volume term.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::study {

struct Equilibrium {
    std::vector<glm::dvec3> positions;  // (points) [m]
    double residual = 0;                // largest acceleration left of a free point, over |g|; that of rounding
    int steps = 0;                      // taken
    bool isAtRest = false;              // the residual fell below the tolerance
};

// Implicit Euler, whose damping is wanted here, with steps that grow as the forces fall: in the end each is a Newton
// step of the balance. Expects gravity that is not zero and a model whose slack parts hang near their place of rest;
// drag rates do not matter. Rounding in stiff springs limits the residual to about 1e-16 k l/(m g).
Equilibrium equilibrium(const mechanics::Model& model, const glm::dvec3& gravity, double tolerance = 2e-6);

}  // namespace taut::study
