// How fast a network can swing: bounds and an estimate of ω_max. The step is chosen from them.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::mechanics {

// The data that the bounds need.
struct NetworkView {
    std::span<const Spring> springs;
    std::span<const double> inverseMasses;   // (points) [1/kg], 0 if held
    std::span<const VolumeCell> cells = {};  // cells that resist a change of their volume
};

struct FrequencyBound {
    double omega = 0;       // [1/s]
    int spring = -1;        // the spring that sets the springs' part; -1: there are no springs
    bool bySprings = true;  // false: generators add more than the springs' part
};

// B1: ω² <= max over springs of S_i w_i + S_j w_j, S_i the summed stiffness at i. It holds in any configuration of a
// network without cells. Expects no cells.
// extraStiffness (points) [N/m], may be empty: row sums of other stiffness. Its largest product with w is added.
FrequencyBound boundAnywhere(const NetworkView& network, std::span<const double> extraStiffness);

// B2: ω² <= max over springs of a_i + a_j, and over cells of the sum over their corners,
//   a_i = w_i λ_max(Σ_springs k [nnᵀ + max(0, 1 - L/l)(I - nnᵀ)] + Σ_cells (K/V0) g gᵀ),  g = ∂V/∂p_i,
// by Cauchy and Schwarz: (Σ g_i·u_i)² <= Σ a_i · Σ (g_i·u_i)²/a_i. The pressure K (V/V0 - 1) of cells couples the ends
// of edges and of diagonals of faces by a cross product with h = Σ_cells K (V/V0 - 1) CellPair::coupling(). So the
// largest row sum (Gershgorin) of √(w_i w_j) |h| is added. The bound holds where the points are now. It is within 1–20
// % of ω_max without cells, and within 29–43 % with cells. positions (points) [m].
FrequencyBound boundHere(const NetworkView& network, std::span<const double> extraStiffness,
                         std::span<const glm::dvec3> positions);

// The largest B2 of the network, stretched evenly to the corners of its working range: `stretch` times along all axes,
// and mirrored along each axis so that V/V0 = -stretch. Mirrored, it is either `stretch` times as thick along the axis,
// or 1/stretch times as thick and `stretch` times as wide. Springs that do not join corners of cells count as in B1.
// Without cells the bound is B1.
FrequencyBound boundWithin(const NetworkView& network, std::span<const double> extraStiffness,
                           std::span<const glm::dvec3> restPositions, double stretch);

// Adds K u of all springs to out (points), at these positions (points) [m]; K = -∂f/∂x [N/m], u (points) [m].
void addSpringStiffness(std::span<const Spring> springs, std::span<const glm::dvec3> positions,
                        std::span<const glm::dvec3> u, std::span<glm::dvec3> out);

// [1/s] ω_max by Lanczos on M^{-1/2} K M^{-1/2}: the largest Ritz value plus its residual, within about 1 % after 20
// products. 0 if nothing is free or stiff. `multiply(u, out)` adds K u to out, both (points).
using StiffnessProduct = std::function<void(std::span<const glm::dvec3>, std::span<glm::dvec3>)>;
double estimateFrequency(std::span<const double> inverseMasses, const StiffnessProduct& multiply, int products = 20);
// Only the Ritz value: ω_max is never below it (Rayleigh), and mostly within a few per cent of it.
double leastFrequency(std::span<const double> inverseMasses, const StiffnessProduct& multiply, int products = 20);

}  // namespace taut::mechanics
