// Edges that pierce triangles, and the direction that separates each pair.
//
// Two sheets cut each other along contours. If a contour parts a sheet, the smaller part is what went through, and goes
// back (Baraff, Witkin and Kass 2003, "Untangling cloth"):
//
//        ______|____         The edges that are cut go straight through the other sheet, towards the larger part.
//       small  |  large  ->  So the contour moves over the small part until nothing of it is left. It may be closed,
//                            or end at the borders of the sheet.
//
// A contour that parts neither sheet begins at a border of one and ends at a border of the other, or crosses edges only
// there and back. It is made shorter until it leaves over the borders (Volino and Magnenat-Thalmann 2006). This alone
// is not enough: a straight contour has no shorter one beside it, so a sheet right through another would stay.
//
// All edges of a contour go the same way. The direction depends on places and connectivity alone: nothing is remembered
// from the time when the sheets were apart.
#pragma once

#include <span>
#include <vector>

#include "taut/contact/bvh.h"

namespace taut::contact {

struct Crossing {
    int edge, triangle;
    dvec3 place;  // [m] where the edge goes through
    // The ends of the edge, and the corners of the triangle with negative weights. As in ContactConstraint: Σ w x is 0.
    std::array<int, 5> points;
    std::array<double, 5> weights;
    dvec3 separatingDirection;  // unit, the direction in which the edge leaves; or zero
    // (points) Whether the point is on the wrong side. If the contour parts a sheet, the points of the smaller part
    // are; otherwise all points are.
    std::array<bool, 5> areThrough;
};

// The direction across an edge, towards the point `beside` on one of its faces; unit, or zero.
dvec3 acrossEdge(const Edge& edge, int beside, std::span<const dvec3> x);

// For an edge of a rigid surface: the normal of a triangle that it pierces, turned to leave the rigid body; zero where
// the edge has only one face, or none.
dvec3 outOfEdge(const Edge& edge, const Triangle& triangle, std::span<const dvec3> x);

// The crossings of surfaces that may touch, at places x (points) [m]; ascending by edge, then triangle.
std::vector<Crossing> findCrossings(const Elements& elements, Bvh& leaves, std::span<const dvec3> x);

}  // namespace taut::contact
