// The step of an island: found from the stability bound or checked against it, fixed before tick 0.
#pragma once

#include <functional>
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
    std::string fault;  // file, line and remedy where the step is so long that the run will end by it; else empty
    std::vector<std::string> advice;  // what would allow a longer step
};

// The step that holds for all that the envelope allows. share: what generators other than the springs and hands add.
// leastOmega: what the fastest motion at the start is not below [1/s], asked only of a step that is over a limit.
// Throws core::Error(badContent) when "auto" has no answer or a tick would need more than a million steps.
StepChoice chooseStep(const Envelope& envelope, mechanics::StabilityShare share, double tickSeconds,
                      const std::function<double()>& leastOmega);

// The largest stable step [s] of the island as it is now, in any configuration.
double stepLimit(const IslandPlan& plan, const mechanics::StabilityShare& share);

// "3.2e-04 s"
std::string inSeconds(double t);

}  // namespace taut::world
