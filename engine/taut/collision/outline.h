// What of a shape reaches between the points of what it meets: its corners and sharp edges, and the middle of what is
// thin and round. It knows no contacts.
#pragma once

#include <vector>

#include "taut/collision/geometry.h"

namespace taut::collision {

struct Facets;

// Edges at which a surface turns by less than that are not sharp. [rad]
inline constexpr double leastSharpness = 0.035;

struct Outline {
    struct Edge {
        int a, b;  // vertices
        // On the two faces beside it, off the edge; -1 where there is none. Both: it is round, or of many faces.
        int wingA = -1, wingB = -1;
    };
    std::vector<dvec3> vertices;  // [m] ends of edges, those that stand alone, and wings
    std::vector<Edge> edges;
    std::vector<int> corners;  // vertices without those that are only wings, ascending
    double radius = 0.0;       // [m] the surface is that far from vertices and edges: of a ball, a capsule
};

// Of triangles that bound a solid the edges that stand out of it; of an open surface all that are sharp, and the
// border.
Outline outlineOf(const Facets& facets);

// Of two rims about the y axis, or one and a tip above it: polygons of so many corners that are drawn into the rims.
inline constexpr int rimCorners = 64;
Outline outlineOfCylinder(double radius, double halfHeight);
Outline outlineOfCone(double radius, double halfHeight);

}  // namespace taut::collision
