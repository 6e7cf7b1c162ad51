// Which points of two edges a seam sews together. It knows no bodies and no time.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::world {

using glm::dvec3;

// The points from one end to the other, the one with the lower number first: along borders of the surface if they lead
// through all of them, else along structural springs. Empty if they are no such line of two points or more.
std::vector<int> lineOf(const mechanics::Model& model, std::span<const int> points);

// Pairs of places of two lines [m]: each place of the one with more goes with the place of the other that is nearest by
// its share of the length, and of the other those that are left likewise. So each has a partner, no two pairs cross, and
// one may have several. The second line is taken backwards if that brings the pairs nearer to each other.
std::vector<std::pair<int, int>> pairedByLength(std::span<const dvec3> a, std::span<const dvec3> b);

}  // namespace taut::world
