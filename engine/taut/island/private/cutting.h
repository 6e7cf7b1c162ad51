// Where a cut crosses bodies, and how it changes an island.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "taut/island/private/island.h"
#include "taut/spec/actions.h"

namespace taut::world {

// The elements of one island that a cut crosses.
struct CutEdges {
    struct Edge {
        Body* body;
        int a, b;      // points of the body's model
        double share;  // of the way from a to b, where the cut crosses
    };
    std::vector<Edge> edges;        // of springs, triangles and tetrahedra
    std::vector<std::size_t> ties;  // of the plan
    bool isEmpty() const { return edges.empty() && ties.empty(); }
};

// The edges and ties that the plane or segment of the action crosses and that are not severed yet. Without plane and
// segment: all of them. A point on the plane counts as in front of it, so every edge is either crossed or not. A
// segment cuts only cloth on a grid.
CutEdges edgesCutBy(const CutAction& action, const Island& island, std::span<Body* const> bodies);

// Severs the edges, the springs along them, and the ties.
void sever(const CutEdges& crossing, IslandPlan& plan);

// Assesses the damage of all bodies and breaks the springs whose edges it calls severed, each after calling
// before(spring). Dynamics::take(Change::damage) makes the forces anew.
void breakSevered(IslandPlan& plan, const std::function<void(int)>& before = {});

}  // namespace taut::world
