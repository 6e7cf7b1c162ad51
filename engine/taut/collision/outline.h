// The parts of a shape that can reach between the points of a body: its corners and sharp edges, and the middle line of
// thin round shapes. It knows no contacts.
#pragma once

#include <vector>

#include "taut/collision/geometry.h"

namespace taut::collision {

struct Facets;

// An edge is not sharp if the surface turns by less than this there. [rad]
inline constexpr double leastSharpness = 0.035;

struct Outline {
    struct Edge {
        int a, b;  // vertices
        // A point on each of the two faces beside the edge, off the edge; -1: no face. Both -1: it is round, or has
        // many faces.
        int wingA = -1, wingB = -1;
    };
    std::vector<dvec3> vertices;  // [m] ends of edges, those that stand alone, and wings
    std::vector<Edge> edges;
    std::vector<int> corners;  // vertices without those that are only wings, ascending
    double radius = 0.0;       // [m] the surface is that far from vertices and edges: of a ball, a capsule
};

// Triangles that bound a solid: the edges that stand out of it. An open surface: all sharp edges, and the border.
Outline outlineOf(const Facets& facets);

// The outline of two rims about the y axis, or of one rim and a tip above it: polygons with so many corners, inscribed
// in the rims.
inline constexpr int rimCorners = 64;
Outline outlineOfCylinder(double radius, double halfHeight);
Outline outlineOfCone(double radius, double halfHeight);

}  // namespace taut::collision
