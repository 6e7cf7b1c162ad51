// The step of an island: found from the stability bound or checked against it, fixed before tick 0.
#pragma once

#include <string>
#include <vector>

#include "taut/mechanics/stability.h"
#include "taut/ode/method.h"
#include "taut/world/envelope.h"

namespace taut::world {

struct StepChoice {
    int substeps = 1;
    double step = 0;        // h = tick / substeps [s]
    double limit = 0;       // largest stable step [s], by the bound that holds in any configuration
    ode::FastestMode mode;  // what the limit is computed from
    mechanics::FrequencyBound anywhere, here;
    std::string limitingSpring;  // what sets the limit, in words; empty when nothing does
    std::vector<std::string> warnings;
};

// The step that holds for all that the envelope allows. share: what generators other than the springs and hands add.
// Throws core::Error(badContent) when "auto" has no answer or would need more than a million steps a tick.
StepChoice chooseStep(const Envelope& envelope, mechanics::StabilityShare share, double tickSeconds);

// The largest stable step [s] of the island as it is now, in any configuration.
double stepLimit(const IslandPlan& plan, const mechanics::StabilityShare& share);

// "3.2e-04 s"
std::string inSeconds(double t);

}  // namespace taut::world
