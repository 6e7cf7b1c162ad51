#include "taut/ode/private/step_limits.h"

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
    // ω⁴ h³/8 - γ/2 = 1/patience. The left side is the growth rate for z well below 1.
    const double rate = 1.0 / patience + 0.5 * drag;
    return std::min(cubeRoot(8.0 * rate / omega), 0.5) / omega;
}

// For ζ < 1 the root of z³/4 - ζ z² + 2ζ² z - 2ζ = 0, at most 2.2. For ζ >= 1 the limit of explicit Euler.
double heunLargestStep(const FastestMode& mode) {
    return explicitLimit(
        mode, 2.0,
        [](double zeta) {
            if (zeta >= 1.0) return overdampedLimit(zeta, 2.0);
            if (zeta <= 0.0) return 0.0;
            return bisect(
                0.0, 2.5,
                [&](double z) { return 0.25 * z * z * z - zeta * z * z + 2.0 * zeta * zeta * z - 2.0 * zeta < 0.0; });
        });
}

// The stable step, with two corrections. It is at least the step at which the fastest motion grows slowly without
// dashpots, unless that motion is overdamped. It is at most the step at which motion across tense springs grows slowly,
// because no dashpot damps it. That motion is taken to have up to a quarter of the fastest frequency, which a tension
// causes that stretches springs by 1/16.
double heunAutomaticStep(const FastestMode& mode) {
    const double limit = heunLargestStep(mode);
    if (mode.omega <= 0.0) return limit;
    const double zeta = dampingRatio(mode, std::max(mode.drag, mode.largestDrag) + mode.rate);
    const double least = zeta < 1.0 ? slowGrowthStep(mode.omega, mode.drag) : 0.0;
    return std::min(std::max(limit, least), slowGrowthStep(0.25 * mode.omega, mode.drag));
}

// Largest h with h²ω² + 4h(τω² + c) < 4. Drag is semi-implicit and does not enter.
double leapfrogLargestStep(const FastestMode& mode) {
    if (mode.omega <= 0.0) return mode.rate > 0.0 ? 1.0 / mode.rate : HUGE_VAL;
    const double omega2 = mode.omega * mode.omega;
    const double s = mode.tau + mode.rate / omega2;
    return 2.0 / (omega2 * (std::sqrt(s * s + 1.0 / omega2) + s));
}

}  // namespace taut::ode
