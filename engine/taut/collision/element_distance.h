// Edges and faces of deformable bodies near a convex shape whose distance is a formula: contact between points.
//
//     a ------x------ b      an edge: the place x inside of it where the distance is least
//           (   )
//           shape
//
//     a face: the place over the point of the shape that reaches furthest towards its plane
#pragma once

#include <optional>

#include "taut/collision/convex.h"

namespace taut::collision {

// In the axes of the shape.
struct ElementNear {
    double distance = 0;  // [m] signed; negative: it is pierced
    dvec3 normal{0.0};    // unit, out of the shape
    double weights[3]{};  // of the points of the element; their sum is 1
};

// The signed distance of a place [m], and its gradient. Expects that shape.closed() is some shape.
Nearest distanceTo(const ClosedShape& shape, const dvec3& place);

// Of an edge from a to b [m], where distanceTo() is `atA` and `atB`; none if an end is nearest.
std::optional<ElementNear> nearestInEdge(const ClosedShape& shape, const dvec3& a, const dvec3& b, const Nearest& atA,
                                         const Nearest& atB);
// Of a triangle [m], on the side of it on which the middle of the shape is; none if that is not over the inside of it.
std::optional<ElementNear> nearestInFace(const Convex& shape, const dvec3& a, const dvec3& b, const dvec3& c);

}  // namespace taut::collision
