// The reference of candidates: the motion at a resolution and a step so fine that its own error is known to be small,
// and the errors of the coarser resolutions.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "taut/study/plan.h"
#include "taut/study/plan_run.h"

namespace taut::study {

// The common part of all runs of a plan.
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
    // Runs a model of the scene within the remaining effort, and counts its cost. Not beyond `most` cost.
    PlanRun run(const world::SceneSpec& model, double most = HUGE_VAL) const;
    // The rest of a share of the effort.
    double left(double share = 1.0) const {
        return share * settings.effort - static_cast<double>(spent.load(std::memory_order_relaxed));
    }
};

// The reference's own error is to be so many times below the target.
inline constexpr double leastShareOfReference = 5;

// Throws core::Error(usage).
[[noreturn]] void failForEffort(const PlanContext& context);

// The motion at a resolution, in double precision with all generators: by Fehlberg's method of order 8, which controls
// its own error. Contact is of order 1 for any method: with contact by RK4, and where explicit steps are far too
// expensive by another method, at ever shorter steps until halving them changes no more.
struct ExactRun {
    PlanRun run;
    double error = HUGE_VAL;  // [m] of its steps, estimated from coarser ones
    std::string method;       // in words
};
// Spends no more than that share of the effort, beyond the first two runs.
ExactRun exactRun(const PlanContext& context, int count, double share);
// The share of its first two runs in the effort.
double exactEffort(const PlanContext& context, int count);

// A candidate has to be near the finest run and near its limit (Richardson): then it is as near to everything in
// between, wherever the truth is. So the reference's own error counts for a candidate in its own direction, and not at
// all for one that errs in another direction.
struct PlanReference {
    PlanRun run, limit;               // at the finest resolution; extrapolated from it and the one before
    int count = 0;                    // of the finest
    double error = 0;                 // [m] of the finest: how far it is from its limit, and that of its steps
    double unknown = 0;               // [m] its part without direction: of its steps, and a share of the rest
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
