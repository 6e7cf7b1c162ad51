// Where a cut crosses what bodies are made of, and what becomes of an island by that.
#pragma once

#include <span>
#include <vector>

#include "taut/island/private/island.h"
#include "taut/spec/actions.h"

namespace taut::world {

// Of one island.
struct CutEdges {
    struct Edge {
        Body* body;
        int a, b;      // points of its model
        double share;  // of the way from a to b
    };
    std::vector<Edge> edges;        // of springs, triangles and tetrahedra
    std::vector<std::size_t> ties;  // of the plan
    bool isEmpty() const { return edges.empty() && ties.empty(); }
};

// What of the bodies lies across the plane or the segment of the action and is not severed yet; all of it where the
// action has neither. A point on the plane counts as in front of it, so that every edge is either crossed or not. A
// segment only cuts cloth on a grid.
CutEdges edgesCutBy(const CutAction& action, const Island& island, std::span<Body* const> bodies);

// Severs the edges, with the springs along them, and the ties.
void sever(const CutEdges& crossing, IslandPlan& plan);

// Breaks the springs of the plan whose edges are severed in the damage of their bodies, which has been assessed.
void breakSevered(IslandPlan& plan);

}  // namespace taut::world
