// Bodies that will pass through each other, since one of them touches nothing: found by a look ahead.
#pragma once

#include <set>
#include <string>
#include <utility>

namespace taut::world {

struct SceneSpec;

struct Encounters {
    std::set<std::pair<std::string, std::string>> pairs;  // "cloth.flag", each in the order of the state hash
    double seen = 0;                                      // [s] of the scene, all of it or as much as is cheap
};

// Pairs of bodies, of different islands, that do not both touch and come into each other's way: the scene is played
// with its timeline and colliders as if all touched, for about so many nanoseconds at most, and who presses on whom, or
// is found in another, is kept. Bodies that start in each other pass through each other meanwhile.
Encounters encounters(const SceneSpec& scene, double most = 1e9);

}  // namespace taut::world
