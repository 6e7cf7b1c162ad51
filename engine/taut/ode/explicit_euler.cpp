// Explicit Euler: y' = y + h f(t, y), from old data only. Order 1. Without damping it is unstable for every step. It is
// kept for comparison.
#include "taut/ode/method.h"
#include "taut/ode/private/runge_kutta.h"
#include "taut/ode/private/step_limits.h"

namespace taut::ode {
namespace {

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeExplicitEuler() {
    return makeRungeKutta<Real>({1, {0.0}, {1}, 1});
}

// ω h <= 2ζ for ζ < 1, and <= 2(ζ - √(ζ²-1)) above. Both limits of h are smallest for the fastest mode: the first is
// τ + γ/ω², and an overdamped mode decays at most at the rate ω (ζ + √(ζ²-1)). Springs under tension add motion that no
// dashpot damps. Then the limit is too high.
double explicitEulerLargestStep(const FastestMode& mode) {
    return explicitLimit(
        mode, 2.0, [](double zeta) { return zeta < 1.0 ? 2.0 * zeta : overdampedLimit(zeta, 2.0); });
}

}  // namespace

MethodInfo explicitEuler() {
    return {.name = "euler",
            .title = "explicit Euler",
            .order = 1,
            .evaluations = 1,
            .storedArrays = 4,
            .symplectic = false,
            .reversible = false,
            .limit = "2ζ; from ζ = 1 on 2(ζ - √(ζ²-1))",
            .caution = "motion that no dashpot damps, such as swinging, grows at every step",
            .largestStep = explicitEulerLargestStep,
            .automaticStep = explicitEulerLargestStep,
            .make = {makeExplicitEuler<float>, makeExplicitEuler<double>}};
}

}  // namespace taut::ode
