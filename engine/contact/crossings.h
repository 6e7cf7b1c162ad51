// Edges that pierce triangles, and which way they come apart.
#pragma once

#include <span>
#include <vector>

#include "taut/contact/patches.h"

namespace taut::contact {

struct Crossing {
    int edge, triangle;
    dvec3 place;  // [m] where the edge goes through
    // As MeetingPair: the ends of the edge, and the corners of the triangle with less than nothing.
    std::array<int, 5> points;
    std::array<double, 5> weights;
    dvec3 apart;  // unit, the way for the edge to go by which the line of intersection grows shorter; or zero
};

// From an edge towards a place on a face beside it, straight off the edge; unit, or zero.
dvec3 acrossEdge(const Edge& edge, int beside, std::span<const dvec3> x);

// The normal of a triangle that an edge of a rigid surface goes through, on the side that is out of that surface; zero
// where none is.
dvec3 outOfEdge(const Edge& edge, const Triangle& triangle, std::span<const dvec3> x);

// Among surfaces that may meet, at places x (points) [m]; ascending by edge and triangle.
std::vector<Crossing> findCrossings(const Elements& elements, Patches& patches, std::span<const dvec3> x);

}  // namespace taut::contact
