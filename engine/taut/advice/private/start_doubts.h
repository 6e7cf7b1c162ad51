// What a scene asks for and hardly means, found before the first tick.
#pragma once

#include <string>
#include <vector>

namespace taut::world {

class World;

// Winds above any storm, cameras inside colliders, bodies that start overstretched, too many steps, and all of
// touchDoubts(), each with a remedy. Expects a world that has not ticked.
std::vector<std::string> startDoubts(World& world);

}  // namespace taut::world
