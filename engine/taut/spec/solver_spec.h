// How a scene is computed: method, step, precision.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace taut::ode {
class Methods;
}

namespace taut::world {

enum class Precision { single_, double_ };
enum class OnDivergence { stop, freeze };

// How leap-frog treats dashpots: at a velocity extrapolated from the last two, or split off, which bears longer steps
// and costs more each.
enum class Dashpots { automatic, extrapolated, split };

struct SolverSpec {
    std::string integrator = "leapfrog";
    std::optional<double> dt;  // [s] largest step; none: found from the stability bound ("auto")
    double safety = 0.9;       // share of the stability limit that "auto" uses
    Precision precision = Precision::single_;
    Dashpots dashpots = Dashpots::automatic;  // whichever takes less time; extrapolated where dt is given
    int newtonSteps = 1;                      // of implicit Euler: linear solves a step, at most
    double cgTolerance = 1e-5;  // of implicit methods: residual over right-hand side at which a solve ends
    int cgIterations = 1000;    // of implicit methods: at most, a solve
    OnDivergence onDivergence = OnDivergence::stop;
    double freezeStrain = 1.0;  // |l - L|/L of a spring (but of bending) at which freezing takes a body to diverge
    std::shared_ptr<const ode::Methods> methods;  // that integrators are names of; none: the engine's own
};

// A body may override these parts of [solver]; none: as the scene has it.
struct SolverOverride {
    std::optional<std::string> integrator;
    std::optional<double> dt;
    std::optional<double> safety;
    std::optional<int> newtonSteps;
    std::optional<double> cgTolerance;
    std::optional<int> cgIterations;
    bool operator==(const SolverOverride&) const = default;
};

}  // namespace taut::world
