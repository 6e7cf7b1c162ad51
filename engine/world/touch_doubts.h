// What a scene asks of bodies that touch and hardly means: found before the first tick.
#pragma once

#include <string>
#include <vector>

namespace taut::world {

class World;

// Bodies that go through each other or themselves as they start, `touch` without anything to touch, thickness above the
// cell. Expects a world that has not ticked.
std::vector<std::string> touchDoubts(World& world);

}  // namespace taut::world
