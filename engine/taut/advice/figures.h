// Contents of the files of a scene's figures.
#pragma once

#include <string>
#include <vector>

#include "taut/core/finding.h"

namespace taut::world {

struct SceneSpec;

// Figures that nothing moves.
std::vector<core::Finding> figureDoubts(const SceneSpec& scene);

// A text for each figure: its size, the names of its animations and joints, and the ignored parts of its file.
std::vector<std::string> figureNotes(const SceneSpec& scene);

}  // namespace taut::world
