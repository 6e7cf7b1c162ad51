// Heun: y' = y + (h/2)(f(t, y) + f(t + h, y + h f(t, y))). Order 2. Undamped motion grows by 1 + z⁴/8 a step, z = ω h.
#include <algorithm>

#include "taut/ode/method_table.h"
#include "taut/ode/runge_kutta.h"
#include "taut/ode/step_limits.h"

namespace taut::ode {

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeHeun() {
    return makeRungeKutta<Real>({2, {0.0, 1.0}, {1, 1}, 2});
}
template std::unique_ptr<FirstOrderMethod<float>> makeHeun();
template std::unique_ptr<FirstOrderMethod<double>> makeHeun();

// ζ < 1: the root of z³/4 - ζ z² + 2ζ² z - 2ζ = 0, at most 2.2; ζ >= 1 as explicit Euler.
double heunLargestStep(const FastestMode& mode) {
    return explicitLimit(mode, 2.0, [](double zeta) {
        if (zeta >= 1.0) return overdampedLimit(zeta, 2.0);
        if (zeta <= 0.0) return 0.0;
        return bisect(0.0, 2.5, [&](double z) {
            return 0.25 * z * z * z - zeta * z * z + 2.0 * zeta * zeta * z - 2.0 * zeta < 0.0;
        });
    });
}

// The stable step, but at least that at which the fastest motion, undamped, grows slowly, unless it is overdamped; and
// no more than that at which motion across tense springs, which no dashpot damps, grows slowly: it is taken to have up
// to a quarter of the fastest frequency, as of a tension that stretches springs by 1/16.
double heunAutomaticStep(const FastestMode& mode) {
    const double limit = heunLargestStep(mode);
    if (mode.omega <= 0.0) return limit;
    const double zeta = dampingRatio(mode, std::max(mode.drag, mode.largestDrag) + mode.rate);
    const double least = zeta < 1.0 ? slowGrowthStep(mode.omega, mode.drag) : 0.0;
    return std::min(std::max(limit, least), slowGrowthStep(0.25 * mode.omega, mode.drag));
}

}  // namespace taut::ode
