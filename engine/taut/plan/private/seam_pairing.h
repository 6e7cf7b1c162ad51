// Which points of two edges a seam sews together. It knows no bodies and no time.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "taut/body/spot.h"
#include "taut/mechanics/model.h"

namespace taut::world {

using glm::dvec3;

// Points one after the other: from one end to the other, or around.
struct Line {
    std::vector<int> points;
    bool isClosed = false;
};

// Along borders of the surface if they lead through all the points, else along structural springs. It begins at the end
// with the lower number, or, closed, at the lowest. Empty if they are no such line of two points or more.
Line lineOf(const mechanics::Model& model, std::span<const int> points);

// (points) Those before and after each on the border of the surface; none inside.
std::vector<std::vector<int>> borderNeighbours(const mechanics::Model& model);

// An edge that a seam sews: places, and how long the edge is between them. It is closed if its ends are one place.
struct SewnEdge {
    std::vector<dvec3> places;  // [m]
    std::vector<double> steps;  // [m] from each to the next; closed: from the last to the first too
    bool isClosed() const { return steps.size() == places.size(); }
};

// A spot of each edge, in numbers of its places; at least one of the two is a place.
struct SewnPair {
    Spot a, b;
    bool operator==(const SewnPair&) const = default;
};
// If each place of either edge is the nearest to one of the other by its share of the length, these are the pairs. Else
// each place of the edge with more goes with the spot of the other at the same share, and so do those of the other that
// no spot has a part of. A closed edge begins where, and either goes the way in which, the pairs are nearest to each
// other.
std::vector<SewnPair> pairedByLength(const SewnEdge& a, const SewnEdge& b);

}  // namespace taut::world
