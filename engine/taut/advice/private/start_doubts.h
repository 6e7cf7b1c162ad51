// Warnings before the first tick: settings that are probably mistakes.
#pragma once

#include <vector>

#include "taut/core/finding.h"

namespace taut::world {

class World;

// Warnings, each with a remedy: winds above any storm, cameras inside colliders, fillings with open seams, bodies that
// start overstretched or weigh far more than the others, figures without animation, too many steps, cuts through bodies
// that do not touch themselves; and those of touchDoubts(). Expects a world that has not ticked.
std::vector<core::Finding> startDoubts(World& world);

}  // namespace taut::world
