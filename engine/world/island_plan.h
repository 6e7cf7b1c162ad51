// Which bodies move together, and with which points and springs: the plan from which an island is built.
#pragma once

#include <span>
#include <vector>

#include "mechanics/mass_spring_system.h"
#include "world/body.h"

namespace taut::world {

// Points in the island's own numbering: body by body, welded points once.
struct IslandPlan {
    std::vector<Body*> bodies;
    SolverSpec solver;
    std::vector<dvec3> positions, velocities;                        // (points)
    std::vector<mechanics::MassSpringSystem<double>::PointMass> points;
    std::vector<mechanics::SpringNetwork<double>::Body> ranges;      // (bodies)
    std::vector<mechanics::Spring> springs;                          // joints last
};

// The smallest sets of bodies that springs or welds couple. Fills pointOf, firstPoint and lastPoint of every body.
// Throws core::Error(badContent) where joints name nothing or bodies tied together disagree on their solver.
std::vector<IslandPlan> planIslands(std::span<Body* const> bodies, const SceneSpec& spec);

// "structural spring 12-13 of cloth.flag" for spring number `spring` of the plan.
std::string describeSpring(const IslandPlan& plan, int spring);

}  // namespace taut::world
