// What a scene asks for and hardly means, found before the first tick.
#pragma once

#include <string>
#include <vector>

namespace taut::world {

class World;

// Winds above any storm, cameras inside colliders, fillings in open seams, bodies that start overstretched or weigh far
// more than the others, figures that nothing moves, too many steps, cuts of what does not touch itself, and all of
// touchDoubts(), each with a remedy. Expects a world that has not ticked.
std::vector<std::string> startDoubts(World& world);

}  // namespace taut::world
