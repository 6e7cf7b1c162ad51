// A candidate's run: the motion of its material, and the cost. Different resolutions are compared at the same places of
// the material, by interpolation between points.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "taut/ode/method.h"
#include "taut/study/plan_candidate.h"
#include "taut/study/plan_need.h"

namespace taut::study {

// When a run is looked at: after every `every` ticks, `samples` times.
struct PlanGrid {
    int every = 1, samples = 10;
    double tick = 1.0 / 60;  // [s]
    int ticksPerFrame = 1;
    int ticks() const { return every * samples; }
    double seconds() const { return tick * ticks(); }
    double frames() const { return static_cast<double>(ticks()) / ticksPerFrame; }
};
// Up to `horizon` [s], at least ten times within it where there are so many ticks.
PlanGrid planGrid(const world::SceneSpec& spec, double horizon);

// Positions of the places of the material at one moment. [m]
using Sight = std::vector<glm::dvec3>;

struct PlanRun {
    std::string failure;          // why there is none or no end of it; empty: it ran to the end
    bool isTooExpensive = false;  // stopped because it cost more than asked for
    std::vector<Sight> at;        // (samples)
    ode::Work work;               // the start's too
    double cost = 0;    // evaluations of the forces, products of a solver counted as such, times the cost of one, see
                        // costOf(); without those of the start, which are made once for any length of the run
    double effort = 0;  // the same with the start, calls and building the world
    double startEffort = 0;  // of that, of building the world
    double springs = 0;
    double seconds = 0;  // of wall time, on one thread
    int substeps = 0;    // a tick, of the island that makes most
    double step = 0;     // [s] of that island
    bool hasContacts = false;
    Scales scales;  // filled on demand

    bool hasEnded() const { return failure.empty() && !isTooExpensive; }
};

struct RunLimits {
    double cost = HUGE_VAL, effort = HUGE_VAL;  // stop beyond
    bool withScales = false;
};

// As a user runs the model: steps follow the state where dt is "auto". Never throws for errors of the scene: a
// divergence is a failure.
PlanRun play(const world::SceneSpec& model, const Resolution& resolution, const PlanGrid& grid,
             const RunLimits& limits = {});

// RMS over places and times. [m] Infinite when one of the runs did not end.
double difference(const PlanRun& a, const PlanRun& b);
// How many looks there are before that exceeds `most`; runs may have ended early.
int samplesWithin(const PlanRun& a, const PlanRun& b, double most);

}  // namespace taut::study
