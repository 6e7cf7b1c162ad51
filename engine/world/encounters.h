// Bodies that will pass through each other, since one of them touches nothing: found by a coarse look ahead. It
// simulates nothing.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace taut::world {

class World;

// Pairs of bodies, of different islands, that do not both touch and come into each other's way. Bodies are taken as
// they start: those that nothing holds fly by their mean velocity and gravity alone until a collider stops them, the
// others stay. Two meet where a point of one passes a point of the other at less than half a spring of each. What
// springs, winds, hands and moving colliders do is not looked at: a swing or a bounce into another body is missed.
// Expects a world that has not ticked.
std::vector<std::pair<std::string, std::string>> encounters(World& world);

}  // namespace taut::world
