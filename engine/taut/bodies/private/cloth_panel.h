// The rows of a cloth that is a panel, and its checks.
#pragma once

#include "taut/fields/field.h"

namespace taut::world {

struct ClothSpec;

fields::Section panelHoleSection();
fields::Section panelEdgeSection();

// Meshes the panel. Reports errors of its outline and its edges, at the corner and the key concerned.
void checkPanel(const fields::CheckInput& input, ClothSpec& cloth);

}  // namespace taut::world
