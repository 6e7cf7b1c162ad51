// What candidates are compared with: the motion at a resolution and a step so fine that its own error is known to be
// small, and the errors of the resolutions on the way there.
#pragma once

#include <map>
#include <optional>

#include "taut/study/plan.h"
#include "taut/study/plan_run.h"

namespace taut::study {

// What all runs of a plan have in common.
struct PlanContext {
    const world::SceneSpec& spec;
    const PlanSettings& settings;
    Resolution resolution;
    PlanGrid grid;
    double target = 0;                                       // [m]
    void tell(const std::string& doing, double done) const;  // throws core::Error when it is to stop
};

// RK4 in double precision, all generators, half of its stable step.
PlanRun exactRun(const PlanContext& context, int count);
// What that would cost, in spring evaluations and what takes as long.
double exactCost(const PlanContext& context, int count);

struct PlanReference {
    PlanRun run;
    int count = 0;
    double error = 0;                 // [m] of the reference, by Richardson's extrapolation
    double order = PlanTrial::unset;  // measured over three resolutions
    std::map<int, PlanRun> runs;      // by count
    double errorOf(const PlanRun& other) const { return difference(other, run) + error; }
};

// Doubles the resolution until the error left is a fifth of the target, or a run would cost too much.
PlanReference makePlanReference(const PlanContext& context);

// The smallest number of cells whose error alone is within the target; none: not even the finest is.
std::optional<int> leastCount(const PlanContext& context, PlanReference& reference);

}  // namespace taut::study
