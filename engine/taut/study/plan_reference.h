// What candidates are compared with: the motion at a resolution and a step so fine that its own error is known to be
// small, and the errors of the resolutions on the way there.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
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
    double target = 0;                             // [m]
    std::string plainMethod = "leapfrog";          // that plays the scene at a step found for it
    mutable std::atomic<std::int64_t> spent = 0;   // of the effort
    mutable std::atomic<bool> isCutShort = false;  // something was not run, or not to its end, for the effort

    void tell(const std::string& doing, double done) const;  // throws core::Error when it is to stop
    // Runs a model of the scene within the effort that is left, and counts what it takes. Not beyond `most` cost.
    PlanRun run(const world::SceneSpec& model, double most = HUGE_VAL) const;
    // Of a share of the effort, less what was spent.
    double left(double share = 1.0) const {
        return share * settings.effort - static_cast<double>(spent.load(std::memory_order_relaxed));
    }
};

// The reference's own error is to be so many times below the target.
inline constexpr double leastShareOfReference = 5;

// Throws core::Error(usage).
[[noreturn]] void failForEffort(const PlanContext& context);

// The motion at a resolution, in double precision with all generators: by Fehlberg's method of order 8, which controls
// its own error. Where there is something to touch, contact is of order 1 whatever the method: there by RK4, and where
// explicit steps are far too dear by another, at ever shorter steps until halving them tells no more.
struct ExactRun {
    PlanRun run;
    double error = HUGE_VAL;  // [m] of its steps, estimated from coarser ones
    std::string method;       // in words
};
// Spends no more than that share of the effort, beyond the first two runs.
ExactRun exactRun(const PlanContext& context, int count, double share);
// What its first two runs would take of the effort.
double exactEffort(const PlanContext& context, int count);

// A candidate has to be near both, the finest run and what it tends to (Richardson): then it is as near to all that
// lies in between, wherever there the truth is. The reference's own error so counts for a candidate in the direction
// that it has, and for one that errs in another direction not at all.
struct PlanReference {
    PlanRun run, limit;               // at the finest resolution; extrapolated from it and the one before
    int count = 0;                    // of the finest
    double error = 0;                 // [m] of the finest: how far it is from its limit, and that of its steps
    double unknown = 0;               // [m] of that, what has no direction: of its steps, and a share of the rest
    double order = PlanTrial::unset;  // measured over three resolutions
    std::string method;               // of its steps, in words
    std::map<int, PlanRun> runs;      // by count
    double errorOf(const PlanRun& other) const {
        return std::max(difference(other, run), difference(other, limit)) + unknown;
    }
};

// Doubles the resolution until its own error is a fifth of the target, or a twentieth where that costs little more, or
// a run would cost too much.
PlanReference makePlanReference(const PlanContext& context);

// The smallest number of cells whose error alone is within the target; none: not even the finest is.
std::optional<int> leastCount(const PlanContext& context, PlanReference& reference);

}  // namespace taut::study
