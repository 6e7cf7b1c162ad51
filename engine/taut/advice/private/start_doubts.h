// What a scene asks for and hardly means, found before the first tick.
#pragma once

#include <string>
#include <vector>

namespace taut::world {

class World;

// Winds no storm has, cameras inside colliders, bodies that start overstretched, steps without number, and all that
// touchDoubts() says; each with a remedy. Expects a world that has not ticked.
std::vector<std::string> startDoubts(World& world);

}  // namespace taut::world
