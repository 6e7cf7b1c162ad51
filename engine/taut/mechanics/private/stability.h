// How fast a network can swing: bounds and an estimate of ω_max, from which the step is chosen.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::mechanics {

// What the bounds need of the points.
struct NetworkView {
    std::span<const Spring> springs;
    std::span<const double> inverseMasses;   // (points) [1/kg], 0 if held
    std::span<const VolumeCell> cells = {};  // that resist a change of their volume
};

struct FrequencyBound {
    double omega = 0;       // [1/s]
    int spring = -1;        // the spring that sets the springs' part, -1 without springs
    bool bySprings = true;  // false: what generators add is more than the springs' part
};

// B1: ω² <= max over springs of S_i w_i + S_j w_j, S_i the summed stiffness at i. Holds in any configuration of a
// network without cells; expects none.
// extraStiffness (points) [N/m], may be empty: row sums of what else is stiff; its largest product with w is added.
FrequencyBound boundAnywhere(const NetworkView& network, std::span<const double> extraStiffness);

// B2: ω² <= max over springs of a_i + a_j, and over cells of the sum over their corners,
//   a_i = w_i λ_max(Σ_springs k [nnᵀ + max(0, 1 - L/l)(I - nnᵀ)] + Σ_cells (K/V0) g gᵀ),  g = ∂V/∂p_i,
// by Cauchy and Schwarz: (Σ g_i·u_i)² <= Σ a_i · Σ (g_i·u_i)²/a_i. What the pressure K (V/V0 - 1) of cells adds couples
// the ends of an edge by a cross product with h = Σ_cells K (V/V0 - 1) (edge opposite)/6: the largest row sum
// (Gershgorin) of √(w_i w_j) |h| is added. Holds where the points are now; within 1–20 % of ω_max without cells, 29–43
// % with. positions (points) [m].
FrequencyBound boundHere(const NetworkView& network, std::span<const double> extraStiffness,
                         std::span<const glm::dvec3> positions);

// The largest B2 of the network stretched evenly to the corners of its working range: `stretch` times along all axes,
// and mirrored through each of them, as thick as before or as thin as leaves the volume at -stretch. Springs that do
// not join corners of cells count as in B1; without cells it is B1.
FrequencyBound boundWithin(const NetworkView& network, std::span<const double> extraStiffness,
                           std::span<const glm::dvec3> restPositions, double stretch);

// K u for all springs at these positions (points) [m], K = -∂f/∂x [N/m], u (points) [m], added to out (points).
void addSpringStiffness(std::span<const Spring> springs, std::span<const glm::dvec3> positions,
                        std::span<const glm::dvec3> u, std::span<glm::dvec3> out);

// ω_max by Lanczos on M^{-1/2} K M^{-1/2}: the largest Ritz value plus its residual, within about 1 % after 20
// products. `multiply(u, out)` adds K u, both (points). [1/s]; 0 when nothing is free or stiff.
using StiffnessProduct = std::function<void(std::span<const glm::dvec3>, std::span<glm::dvec3>)>;
double estimateFrequency(std::span<const double> inverseMasses, const StiffnessProduct& multiply, int products = 20);
// The Ritz value alone, which no ω_max is below (Rayleigh): mostly within a few per cent of it.
double leastFrequency(std::span<const double> inverseMasses, const StiffnessProduct& multiply, int products = 20);

}  // namespace taut::mechanics
