// The step of an island: found from the stability bound or checked against it, fixed before tick 0.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/stability.h"
#include "taut/mechanics/state_bound.h"
#include "taut/ode/method.h"
#include "taut/island/envelope.h"
#include "taut/island/step_following.h"

namespace taut::world {

// How many substeps a tick needs, at the chosen share of the longest stable step, as the bound of the state asks.
struct StepNeed {
    const ode::MethodInfo* method = nullptr;
    double tickSeconds = 0, safety = 0;
    ode::FastestMode others;   // all but ω and dashpots
    double moreOmega2 = 0;     // [1/s²] what generators and hands add at most
    double leastTauShare = 1;  // of the damping that there is, the least that ever will be
    bool splits = false;       // the dashpots off

    double operator()(const mechanics::FastestNow& now) const;
    // Allows for what generators have come to add.
    void raise(const mechanics::StabilityShare& share, std::span<const double> inverseMasses);
};

struct StepChoice {
    int substeps = 1;
    std::optional<StepNeed> need;  // of an island whose step follows its state
    bool splits = false;           // the dashpots off
    double step = 0;               // h = tick / substeps [s]
    double limit = 0;  // largest stable step [s], by the bound that holds in any shape, of cells in any they may take
    ode::FastestMode mode;  // what the limit is computed from
    mechanics::FrequencyBound anywhere, here;
    std::string limitingSpring;  // what sets the limit, in words; empty when nothing does
    std::vector<std::string> warnings;
    std::string fault;  // file, line and remedy where the step is so long that the run will end by it; else empty
    std::vector<std::string> advice;  // what would allow a longer step
};

// Without `now` the step that holds for all that the envelope allows; with it, where dt is "auto" and the method's
// limit is a promise, one that holds for that state, and the rule by which it may change. share: what generators other
// than the springs and hands add. leastOmega: what the fastest motion at the start is not below [1/s], asked only of a
// step that is over a limit. inParts: how many substeps a tick takes that needs so many. Throws
// core::Error(badContent) when "auto" has no answer or a tick would need more than a million steps.
StepChoice chooseStep(const Envelope& envelope, mechanics::StabilityShare share, double tickSeconds,
                      const std::function<double()>& leastOmega, const mechanics::FastestNow* now,
                      const std::function<int(int)>& inParts);

// The largest stable step [s] of the island as it is now, in any configuration.
double stepLimit(const IslandPlan& plan, const mechanics::StabilityShare& share);

// "3.2e-04 s"
std::string inSeconds(double t);

}  // namespace taut::world
