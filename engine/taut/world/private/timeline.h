// The actions of a scene when they are due, and what they have in common: the points that they name.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "taut/bodies/body.h"
#include "taut/spec/actions.h"

namespace taut::world {

class Island;
struct WorldImpl;

// Does those whose tick it is.
void performDue(World& world);

// A point that an action names.
struct Picked {
    Island* island = nullptr;
    const Body* body = nullptr;
    int point = -1;  // in the island
};

// The points that it names, each once, ascending by island; only the nearest if it says where. Throws
// core::Error(badContent) if there is none.
std::vector<Picked> pick(const WorldImpl& w, const PointsAction& action);
double massOf(const Picked& point);  // [kg]
// The islands of picked points with their points in each, in order; frozen ones are left out.
std::vector<std::pair<Island*, std::vector<int>>> byIsland(const std::vector<Picked>& points);

[[noreturn]] void failAction(const ActionSpec& action, const std::string& message);

}  // namespace taut::world
