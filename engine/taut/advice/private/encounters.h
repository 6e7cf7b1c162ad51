// Looks ahead for bodies that will pass through each other, or let a collider through, because one of them touches
// nothing.
#pragma once

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace taut::world {

struct SceneSpec;

struct Encounters {
    std::set<std::pair<std::string, std::string>> pairs;  // "cloth.flag", each in the order of the state hash
    // "cloth.flag" and "collider.post", which fits between its points; its width [m].
    std::map<std::pair<std::string, std::string>, double> posts;
    double seen = 0;  // [s] of the scene: all of it, or as much as is cheap
};

// Pairs of bodies of different islands that meet and do not both touch, and colliders that fit between the points of
// bodies that meet them by points alone. Plays the scene, with its timeline and colliders, as if all bodies touched,
// for some `most` nanoseconds, or until the process has spent `end` seconds of processor time. Keeps who presses on
// whom or is found in another. Bodies that start inside each other pass through each other meanwhile.
Encounters encounters(const SceneSpec& scene, double most = 1e9, double end = HUGE_VAL);

}  // namespace taut::world
