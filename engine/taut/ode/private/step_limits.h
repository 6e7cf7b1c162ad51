// Shared by the step limits of the methods: a mode's damping ratio, and roots found with only + - * /.
#pragma once

#include <functional>
#include <string_view>

#include "taut/ode/method.h"

namespace taut::ode {

// The limit [s] of methods that treat all damping explicitly. z(ζ) is the largest stable ω h of a mode of damping ratio
// ζ. `rate` is the largest stable h times a rate, for a point that no spring holds. With dashpots and drag
// ζ = (τ ω + γ/ω)/2. Wind and anchors damp only some modes, and drag may differ from point to point, so the smallest of
// the limits counts.
double explicitLimit(const FastestMode& mode, double rate, double (*z)(double zeta));

// ζ of a mode with ω > 0 that is damped at `rate` [1/s] besides its dashpots.
inline double dampingRatio(const FastestMode& mode, double rate) {
    return 0.5 * (mode.tau * mode.omega + rate / mode.omega);
}

// ω h at which a mode of ζ >= 1 has h λ = `real` for the larger of its two rates λ.
double overdampedLimit(double zeta, double real);

// The number between low and high where `isBelow` turns from true to false, up to the last few bits.
double bisect(double low, double high, const std::function<bool(double)>& isBelow);

// Cube root of x >= 0. The C library's root may differ from processor to processor.
double cubeRoot(double x);

// Heun and midpoint let undamped motion grow by 1 + z⁴/8 a step, so no step is stable for ever. But a short step is
// good for a long time: slowGrowthStep() is the step at which motion of this frequency grows e-fold in `patience`.
inline constexpr double patience = 10.0;           // [s]
double slowGrowthStep(double omega, double drag);  // [s]; omega > 0 and drag >= 0 [1/s]
inline constexpr std::string_view growthCaution =
    "motion that nothing damps grows at every step: dt = \"auto\" keeps it to a factor of e in 10 s";

// [s] Limits that two methods have in common. Heun and midpoint are the same on linear problems. Leap-frog and velocity
// Verlet have the same positions.
double heunLargestStep(const FastestMode& mode);
double heunAutomaticStep(const FastestMode& mode);
double leapfrogLargestStep(const FastestMode& mode);

}  // namespace taut::ode
