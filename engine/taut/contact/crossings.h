// Edges that pierce triangles, and which way they come apart.
//
// Two sheets cut each other along contours. Where a contour parts a sheet, the smaller part is what went through, and
// goes back (Baraff, Witkin and Kass, "Untangling cloth", 2003):
//
//        ______|____         the edges that are cut go straight through the other sheet, towards the larger part:
//       small  |  large  ->  the contour moves over the small part until nothing is left of it, whether it closes in
//                            itself or ends at borders
//
// One that parts neither begins at a border of the one and ends at one of the other, or goes through no edge but there
// and back: it is made shorter, until it is drawn out over the borders (Volino and Magnenat-Thalmann 2006). A straight
// one has no shorter one beside it, so that this alone would leave a sheet that is right through another where it is.
// All of a contour goes the same way. Places and what hangs together decide, nothing is remembered.
#pragma once

#include <span>
#include <vector>

#include "taut/contact/bvh.h"

namespace taut::contact {

struct Crossing {
    int edge, triangle;
    dvec3 place;  // [m] where the edge goes through
    // As ContactConstraint: the ends of the edge, and the corners of the triangle with less than nothing.
    std::array<int, 5> points;
    std::array<double, 5> weights;
    dvec3 apart;  // unit, the way for the edge to go; or zero
    // (points) Where its contour parts a surface, those of the smaller part, which are on the wrong side; else all.
    std::array<bool, 5> areThrough;
};

// From an edge towards a place on a face beside it, straight off the edge; unit, or zero.
dvec3 acrossEdge(const Edge& edge, int beside, std::span<const dvec3> x);

// The normal of a triangle that an edge of a rigid surface goes through, on the side that is out of that surface; zero
// where none is.
dvec3 outOfEdge(const Edge& edge, const Triangle& triangle, std::span<const dvec3> x);

// Among surfaces that may meet, at places x (points) [m]; ascending by edge and triangle.
std::vector<Crossing> findCrossings(const Elements& elements, Bvh& leaves, std::span<const dvec3> x);

}  // namespace taut::contact
