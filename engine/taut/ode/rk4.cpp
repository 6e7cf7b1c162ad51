// The classical Runge-Kutta method. Order 4. Undamped motion is stable up to ω h = 2√2.
#include <cmath>

#include "taut/ode/method.h"
#include "taut/ode/private/runge_kutta.h"
#include "taut/ode/private/step_limits.h"

namespace taut::ode {
namespace {

// |R(w)|² with R = Σ w^j/j!, j <= 4, at w = z (-ζ + i √(1-ζ²)).
double amplification(double z, double zeta) {
    const double re = -zeta * z, im = z * std::sqrt(1.0 - zeta * zeta);
    double a = 1.0, b = 0.0;  // Horner: R = 1 + w (1 + w/2 (1 + w/3 (1 + w/4)))
    for (int j = 4; j >= 1; --j) {
        const double c = (a * re - b * im) / j, d = (a * im + b * re) / j;
        a = 1.0 + c;
        b = d;
    }
    return a * a + b * b;
}

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeRk4() {
    return makeRungeKutta<Real>({4, {0.0, 0.5, 0.5, 1.0}, {1, 2, 2, 1}, 6});
}

// The limit is |R(w)| = 1. All of the left half plane within |w| <= 2.5 is stable, and nothing beyond 3.5.
double rk4LargestStep(const FastestMode& mode) {
    constexpr double real = 2.785293563405282;  // on the real axis: w³ + 4w² + 12w + 24 = 0
    return explicitLimit(mode, real, [](double zeta) {
        if (zeta >= 1.0) return overdampedLimit(zeta, real);
        return bisect(2.5, 3.5, [&](double z) { return amplification(z, zeta) < 1.0; });
    });
}

}  // namespace

MethodInfo rungeKutta4() {
    return {.name = "rk4",
            .title = "Runge-Kutta 4",
            .order = 4,
            .evaluations = 4,
            .storedArrays = 8,
            .symplectic = false,
            .reversible = false,
            .limit = "2√2 at ζ = 0; from ζ = 1 on 2.785(ζ - √(ζ²-1)); between |R(w)| = 1",
            .caution = "",
            .largestStep = rk4LargestStep,
            .automaticStep = rk4LargestStep,
            .make = {makeRk4<float>, makeRk4<double>}};
}

}  // namespace taut::ode
