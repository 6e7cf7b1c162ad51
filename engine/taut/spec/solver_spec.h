// How a scene is computed: method, step, precision.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "taut/core/value.h"

namespace taut::ode {
class Methods;
}

namespace taut::world {

enum class Precision { single_, double_ };
enum class OnDivergence { stop, freeze };

// How leap-frog treats dashpots: at a velocity extrapolated from the last two, or split off. Splitting allows longer
// steps, but each costs more.
enum class Dashpots { automatic, extrapolated, split };

struct SolverSpec {
    TAUT_VALUE(SolverSpec);
    std::string integrator = "leapfrog";
    std::optional<double> dt;  // [s] largest step; none: found from the stability bound ("auto")
    double safety = 0.9;       // share of the stability limit that "auto" uses
    Precision precision = Precision::single_;
    Dashpots dashpots = Dashpots::automatic;  // automatic: the faster of the two; extrapolated if dt is given
    int newtonSteps = 1;                      // of implicit Euler: most linear solves in a step
    double cgTolerance = 1e-5;  // of implicit methods: residual over right-hand side at which a solve ends
    int cgIterations = 1000;    // of implicit methods: most iterations in a solve
    OnDivergence onDivergence = OnDivergence::stop;
    double freezeStrain = 1.0;  // |l - L|/L of a spring (not of bending) above which freezing takes a body as diverged
    double sleepError = 0;      // [m] furthest that sleep may leave a point from where it would be; 0: nothing sleeps
    std::shared_ptr<const ode::Methods> methods;  // that integrators are named in; none: the engine's own
};

// The parts of [solver] that a body may override; none: as in the scene.
struct SolverOverride {
    TAUT_VALUE(SolverOverride);
    std::optional<std::string> integrator;
    std::optional<double> dt;
    std::optional<double> safety;
    std::optional<int> newtonSteps;
    std::optional<double> cgTolerance;
    std::optional<int> cgIterations;
    bool operator==(const SolverOverride&) const = default;
};

}  // namespace taut::world
