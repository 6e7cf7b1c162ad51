#include "taut/ode/step_limits.h"

#include <algorithm>
#include <cmath>

namespace taut::ode {

double explicitLimit(const FastestMode& mode, double rate, double (*z)(double zeta)) {
    const double mostDrag = std::max(mode.drag, mode.largestDrag);
    if (mode.omega <= 0.0) {
        const double fastest = mode.rate + mostDrag;
        return fastest > 0.0 ? rate / fastest : HUGE_VAL;
    }
    double limit = HUGE_VAL;
    for (double damping : {mode.drag, mode.drag + mode.rate, mostDrag + mode.rate})
        limit = std::min(limit, z(dampingRatio(mode, damping)) / mode.omega);
    return limit;
}

double overdampedLimit(double zeta, double real) {
    return real / (zeta + std::sqrt(zeta * zeta - 1.0));
}

double bisect(double low, double high, const std::function<bool(double)>& isBelow) {
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (isBelow(middle) ? low : high) = middle;
    }
    return low;
}

double cubeRoot(double x) {
    double top = 1.0;
    while (top * top * top < x) top *= 2.0;
    return bisect(0.0, top, [&](double r) { return r * r * r < x; });
}

double slowGrowthStep(double omega, double drag) {
    // ω⁴ h³/8 - γ/2 = 1/patience, which is the growth for z well below 1.
    const double rate = 1.0 / patience + 0.5 * drag;
    return std::min(cubeRoot(8.0 * rate / omega), 0.5) / omega;
}

}  // namespace taut::ode
