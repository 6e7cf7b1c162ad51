// The midpoint method: y' = y + h f(t + h/2, y + (h/2) f(t, y)). Order 2. Undamped motion grows by 1 + z⁴/8 a step.
#include "taut/ode/method.h"
#include "taut/ode/private/runge_kutta.h"
#include "taut/ode/private/step_limits.h"

namespace taut::ode {
namespace {

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeMidpoint() {
    return makeRungeKutta<Real>({2, {0.0, 0.5}, {0, 1}, 1});
}

}  // namespace

MethodInfo midpoint() {
    return {.name = "midpoint",
            .title = "midpoint",
            .order = 2,
            .evaluations = 2,
            .storedArrays = 6,
            .symplectic = false,
            .reversible = false,
            .limit = "as Heun",
            .caution = growthCaution,
            .largestStep = heunLargestStep,
            .automaticStep = heunAutomaticStep,
            .make = {makeMidpoint<float>, makeMidpoint<double>}};
}

}  // namespace taut::ode
