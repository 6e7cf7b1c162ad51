// Whether a cloth's cells are fine enough for how its material bends.
#pragma once

#include <string>
#include <vector>

namespace taut::world {

struct SceneSpec;

// [m] (B/ρg)^⅓, the length at which bending and weight balance (Peirce 1930). B [N m], ρ [kg/m²], g [m/s²], each > 0.
double bendingLength(double rigidity, double density, double gravity);

// By how much the droop of a strip that hangs from a table is wrong, as a share of it, with cells of this length [m]:
// 0.45 (a/ℓ)², measured at bends from slight to steep, where the factor is 0.37 to 0.54.
double droopError(double cell, double bendingLength);
double cellFor(double droopError, double bendingLength);  // its inverse [m]

// Of the first grid of cloth of each material whose cells err by more than a tenth: by how much, and which would do.
std::vector<std::string> coarseCells(const SceneSpec& scene);

}  // namespace taut::world
