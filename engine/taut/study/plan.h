// From the need of a scene to the cheapest way to model and compute it, with the evidence. It writes nothing.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "taut/core/private/listener.h"
#include "taut/scene/private/splice.h"
#include "taut/study/plan_candidate.h"
#include "taut/study/plan_need.h"
#include "taut/study/work_precision.h"

namespace taut::study {

struct PlanSettings {
    double effort = 2e10;  // all runs together: evaluations times springs and points, and equivalent work
    core::Listener listener{};
};

// The effect of leaving out a force generator.
struct GeneratorTrial {
    std::string name;
    double change = 0;  // [m] RMS; infinite when the motion diverges without it
    bool isLeftOut = false;
    std::string verdict;
};

// The error of a resolution alone, other things being exact.
struct ResolutionTrial {
    int count = 0;  // cells along the longest edge
    double springs = 0;
    double error = 0;  // [m]
    bool isEnough = false;
};

// A way to compute the scene, all errors of it together.
struct PlanTrial {
    static constexpr double unset = std::numeric_limits<double>::quiet_NaN();
    Candidate candidate;
    bool isAsWritten = false;
    double error = unset;         // [m] RMS against the reference, the reference's own error added
    double step = unset;          // [s]
    double cost = unset;          // a frame, see PlanRun; of one not run to its end, a lower bound
    double milliseconds = unset;  // a frame, on one thread; of a run to its end only
    double springs = 0;
    double evaluations = unset;  // of the forces, solver products included, a frame
    bool meets = false, wasRun = false;
    bool wasStopped = false;  // before its end, as it cost more than a better one
    bool hasWholeCost() const { return wasRun && !wasStopped; }
    std::string verdict;
};

struct Verification {
    double step = PlanTrial::unset;   // [m] change at a quarter of the step
    double finer = PlanTrial::unset;  // [m] change at twice the resolution too; unset: it has only one
    int count = 0;                    // the cells then
    bool isPassed = false;
    bool isCutShort = false;  // by the effort
};

struct Plan {
    std::string name;
    Need need;
    double seconds = 0;       // [s] that the motion can be promised for: the horizon asked for, or less
    bool isCutShort = false;  // by the effort, before all was tried
    double spent = 0;         // of the effort
    bool isChaotic = false;   // the motion cannot be predicted for as long as was asked; then nothing else was tried
    double jitter = 0, jitterMoves = 0;  // [m] by which the start was shaken to see that, and how far that went
    double runSeconds = 0;               // [s] of the whole run
    Resolution resolution;
    std::vector<GeneratorTrial> generators;
    std::vector<ResolutionTrial> resolutions;  // by count
    double order = PlanTrial::unset;           // of convergence with the resolution, as measured
    double referenceError = 0;                 // [m]
    std::string referenceMethod;               // of its steps, in words
    int referenceCount = 0;
    std::vector<PlanTrial> trials;      // in the order of trying
    std::optional<std::size_t> chosen;  // of trials
    int alsoTried = 0;                  // around the cheapest, none of which was cheaper; not among the trials
    Verification verification;
    double ratio = 1;  // cost as written over cost as planned; NaN when that was not run to its end
    double secondsAnEvaluation = PlanTrial::unset;  // of all forces
    std::vector<scene::Change> changes;             // of the scene file
    std::vector<std::string> remarks;

    bool isAccurate() const { return chosen.has_value() && verification.isPassed; }
    bool isInBudget() const { return chosen && (!need.budget || trials[*chosen].milliseconds <= *need.budget); }
    bool isMet() const { return isAccurate() && isInBudget() && !isChaotic; }
    // [s] at the end of the run that no promise covers.
    double unseen() const { return runSeconds > seconds * (1 + 1e-9) ? runSeconds - seconds : 0.0; }
};

// Motion is chaotic where a jitter of the start by 1e-5 m, or by a tenth of the target if that is less, moves points by
// more than the target: candidates would differ by the disturbance, not by how well they compute. Nothing is tried
// then. Throws core::Error: badContent where [need] is missing or contradicts the scene or nothing can move, diverged
// where even the smallest steps do, interrupted.
Plan makePlan(const world::SceneSpec& spec, const PlanSettings& settings = {});

}  // namespace taut::study
