// Heun: y' = y + (h/2)(f(t, y) + f(t + h, y + h f(t, y))). Order 2. Undamped motion grows by 1 + z⁴/8 a step, z = ω h.
#include "taut/ode/method.h"
#include "taut/ode/private/runge_kutta.h"
#include "taut/ode/private/step_limits.h"

namespace taut::ode {
namespace {

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeHeun() {
    return makeRungeKutta<Real>({2, {0.0, 1.0}, {1, 1}, 2});
}

}  // namespace

MethodInfo heun() {
    return {.name = "heun",
            .title = "Heun",
            .order = 2,
            .evaluations = 2,
            .storedArrays = 8,
            .symplectic = false,
            .reversible = false,
            .limit = "root of z³/4 - ζz² + 2ζ²z - 2ζ; from ζ = 1 on as Euler",
            .caution = growthCaution,
            .largestStep = heunLargestStep,
            .automaticStep = heunAutomaticStep,
            .make = {makeHeun<float>, makeHeun<double>}};
}

}  // namespace taut::ode
