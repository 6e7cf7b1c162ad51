// The parts of a hull or a mesh that can reach between the points of a body: its corners and sharp edges. Edges and
// faces meet other shapes by their distance (element_distance.h). It knows no contacts.
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
        // A point on each of the two faces beside the edge, off the edge; -1: no face. Both -1: it has many faces.
        int wingA = -1, wingB = -1;
    };
    std::vector<dvec3> vertices;  // [m] ends of edges, and wings
    std::vector<Edge> edges;
    std::vector<int> corners;  // vertices, without vertices of wings only, ascending
    bool isConvex = false;     // its source
};

// Triangles that bound a solid: the edges that stand out of it. An open surface: all sharp edges, and the border.
Outline outlineOf(const Facets& facets);

}  // namespace taut::collision
