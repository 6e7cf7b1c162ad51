// The step of an island: found from the stability bound, or checked against it, before tick 0.
//
// An explicit method is stable for a mode ω with damping ratio ζ while ω h < z(ζ); its row in the table of methods has
// z. The step is a tick divided by a whole number of substeps, so that every tick ends at its own time.
//
// - Which ω. Eigenvalues cost too much, so bounds take their place. `anywhere` (B1) holds in any shape, `here` (B2) in
//   the present one. Both are taken of the envelope: the stiffest springs, lightest masses and strongest forces that
//   the timeline will make. No later action then makes the step too long.
// - A given dt is kept. A step over the limit gets a warning. It is a fault only where growth is certain, by a
//   frequency that the motion is known to reach, not by an upper bound.
// - dt = "auto" takes the share `safety` of the limit. Where the limit is a promise and the state is known, the step
//   follows the state: StepNeed computes the need at the end of each tick, step_following.h decides. Methods with a
//   caution let undamped motion grow at every step; they keep one step, at which it grows slowly.
// - Linear stability is not enough for springs. Near ω h = √3 a mode takes three steps to turn, and the third-order
//   resonance makes wide swings grow (Schlick, Mandziuk, Skeel and Srinivas 1998). Symplectic methods
//   keep undamped motion at ω h < 1.5.
// - Leap-frog sees dashpots at an extrapolated velocity, which lowers its limit. Split off (ode/split_leapfrog.cpp)
//   they leave ω h < 2, but a step costs 2.5 times as much. Whichever needs less time for a tick is chosen.
//
// All of it is a function of the scene and the state at the start, so every run of a scene chooses the same.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/island/private/envelope.h"
#include "taut/island/private/step_following.h"
#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/private/stability.h"
#include "taut/mechanics/private/state_bound.h"
#include "taut/ode/method.h"

namespace taut::world {

// How many substeps a tick needs in the present state, at the chosen share of the longest stable step.
struct StepNeed {
    const ode::MethodInfo* method = nullptr;
    double tickSeconds = 0, safety = 0;
    ode::FastestMode others;   // all but ω and dashpots
    double moreOmega2 = 0;     // [1/s²] largest addition by generators and hands
    double leastTauShare = 1;  // smallest share of the present damping that there will ever be
    bool splits = false;       // the dashpots act apart from the other forces

    double operator()(const mechanics::FastestNow& now) const;
    // Takes account of additions by generators since the start.
    void raise(const mechanics::StabilityShare& share, std::span<const double> inverseMasses);
};

struct StepChoice {
    int substeps = 1;
    std::optional<StepNeed> need;  // if the step of the island follows its state
    bool splits = false;           // the dashpots act apart from the other forces
    double step = 0;               // h = tick / substeps [s]
    double limit = 0;              // largest stable step [s], by the bound that holds in any shape, also of cells
    ode::FastestMode mode;         // source of the limit
    mechanics::FrequencyBound anywhere, here;
    std::string limitingSpring;  // cause of the limit, in words; empty: no limit
    std::vector<std::string> warnings;
    std::optional<core::Finding> fault;  // if the step is so long that it will end the run
    std::vector<std::string> advice;     // changes that would allow a longer step
};

// Without `now`: the step that holds for all that the envelope allows. With `now`, where dt is "auto" and the method's
// limit is a promise: a step that holds for that state, and the rule by which it may change. share: of the generators,
// besides springs and hands. leastOmega(): a lower bound of the fastest motion at the start [1/s], called only for a
// step over a limit. inParts(n): the substeps of a tick that needs n. Throws core::Error(badContent) when "auto" has no
// answer or a tick would need more than a million steps.
StepChoice chooseStep(const Envelope& envelope, mechanics::StabilityShare share, double tickSeconds,
                      const std::function<double()>& leastOmega, const mechanics::FastestNow* now,
                      const std::function<int(int)>& inParts);

// The body whose spring sets a bound; the first one, if that is no body's.
const Body& limitingBody(const IslandPlan& plan, const mechanics::FrequencyBound& bound);

// The largest stable step [s] of the island as it is now, in any configuration.
double stepLimit(const IslandPlan& plan, const mechanics::StabilityShare& share);

// "3.2e-04 s"
std::string inSeconds(double t);

}  // namespace taut::world
