// Performs the actions of a scene that are due, and finds the points that they name.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "taut/body/body.h"
#include "taut/spec/actions.h"

namespace taut::world {

class Island;
struct WorldImpl;

// Performs the actions of the present tick.
void performDue(World& world);

// A point that an action names.
struct Picked {
    Island* island = nullptr;
    const Body* body = nullptr;
    int point = -1;  // in the island
};

// The points that an action names, each once, ascending by island; only the nearest point if it gives a place. Throws
// core::Error(badContent) if there is none.
std::vector<Picked> pick(const WorldImpl& w, const PointsAction& action);
double massOf(const Picked& point);  // [kg]
// The islands of picked points, with their points in order. Leaves out frozen islands.
std::vector<std::pair<Island*, std::vector<int>>> byIsland(const std::vector<Picked>& points);

[[noreturn]] void failAction(const ActionSpec& action, const std::string& message);

}  // namespace taut::world
