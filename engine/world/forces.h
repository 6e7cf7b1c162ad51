// What acts on the bodies of a scene besides their springs, resolved to bodies and points.
#pragma once

#include <span>
#include <vector>

#include "taut/mechanics/linear_path.h"
#include "taut/mechanics/wind.h"
#include "taut/world/body.h"

namespace taut::world {

struct WindOn {
    mechanics::LinearPath velocity;  // [m/s]
    mechanics::WindSettings settings;
    std::vector<const Body*> bodies;
};
struct AnchorOn {
    mechanics::LinearPath place;        // [m]
    double stiffness = 0, damping = 0;  // of each point
    const Body* body = nullptr;
    std::vector<int> points;  // of the body
};

struct IslandForces {
    mechanics::LinearPath gravity;  // [m/s²]
    std::vector<WindOn> winds;
    std::vector<AnchorOn> anchors;
};

// The forces of a scene on these bodies. An anchor that finds no point does nothing.
IslandForces resolveForces(const WorldSpec& world, std::span<const WindSpec> winds, std::span<const AnchorSpec> anchors,
                           std::span<Body* const> bodies);

// The same forces changing evenly from one moment [s] to the other in what may change so: gravity, flows and places.
// All else is as in `middle`. Expects the same bodies.
IslandForces between(const IslandForces& from, const IslandForces& middle, const IslandForces& to, double t0,
                     double t1);

// Whether forces go on without a jump: equal but for gravity and flows, which begin where they ended, and the places of
// anchors, which move on as fast as before.
bool goesOn(const IslandForces& before, const IslandForces& now);

}  // namespace taut::world
