// Fields of the scene that change while it runs.
#pragma once

#include <cstdint>
#include <vector>

#include "taut/bodies/body.h"
#include "taut/spec/actions.h"

namespace taut::world {

struct WorldImpl;

// A field on its way; one that has arrived is kept, as its value is no longer the scene's own.
struct Ramp {
    RampAction action;
    std::vector<double> from;
    std::int64_t start = 0;   // tick
    std::int64_t length = 0;  // ticks; 0: at once
};

// What they change in the coming tick, each where it acts.
void changeForces(WorldImpl& w);
void changeSprings(WorldImpl& w);
void changeColliders(WorldImpl& w);
void changePicture(WorldImpl& w);  // at its start

// Entities have specs of their own: what ramps have changed of the scene's goes over to them.
void takeRampedParts(WorldImpl& w);
// Takes the springs over that the body would have if it were built from the scene as it is now.
void takeSprings(const SceneSpec& spec, Body& body);

}  // namespace taut::world
