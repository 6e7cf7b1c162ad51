// Fields of the scene that change during a run.
#pragma once

#include <cstdint>
#include <vector>

#include "taut/body/body.h"
#include "taut/spec/actions.h"

namespace taut::world {

struct WorldImpl;

// A field on its way. A field that has arrived is kept, because its value is no longer that of the scene.
struct Ramp {
    RampAction action;
    std::vector<double> from;
    std::int64_t start = 0;   // tick
    std::int64_t length = 0;  // ticks; 0: at once
};

// Apply the changes of the coming tick, each to its own part.
void changeForces(WorldImpl& w);
void changeSprings(WorldImpl& w);
void changeColliders(WorldImpl& w);
void changePicture(WorldImpl& w);  // to its value at the start of that tick

// Copies ramped values of the scene to the entities, which have specs of their own.
void takeRampedParts(WorldImpl& w);
// Takes the springs that the body would have if it were built from the scene in its present state.
void takeSprings(const SceneSpec& spec, Body& body);

}  // namespace taut::world
