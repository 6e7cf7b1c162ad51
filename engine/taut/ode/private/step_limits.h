// What the limits of the methods share: a mode's damping ratio, and roots found with + - * / alone.
#pragma once

#include <functional>
#include <string_view>

#include "taut/ode/method.h"

namespace taut::ode {

// For methods that see all damping explicitly. z(ζ) is the largest stable ω h of a mode of damping ratio ζ; rate the
// largest h times a rate of a point that no spring holds. With dashpots and drag ζ = (τ ω + γ/ω)/2. Wind and anchors
// damp some modes and not others, drag may differ from point to point: the smallest of the limits counts.
double explicitLimit(const FastestMode& mode, double rate, double (*z)(double zeta));

// ζ of a mode of rate ω > 0 when other things damp it at `rate` [1/s].
inline double dampingRatio(const FastestMode& mode, double rate) {
    return 0.5 * (mode.tau * mode.omega + rate / mode.omega);
}

// ω h at which a mode of ζ >= 1 has h λ = `real` for the larger of its two rates λ.
double overdampedLimit(double zeta, double real);

// The number between low and high where `isBelow` turns from true to false, up to the last few bits.
double bisect(double low, double high, const std::function<bool(double)>& isBelow);

// Cube root of x >= 0; the C library's may differ from processor to processor.
double cubeRoot(double x);

// Heun and midpoint let undamped motion grow by 1 + z⁴/8 a step, so no step is stable for ever,
// but a short one is good for long: the step at which motion of that frequency grows e-fold in `patience` seconds.
inline constexpr double patience = 10.0;           // [s]
double slowGrowthStep(double omega, double drag);  // [s], of omega > 0 and drag >= 0 [1/s]
inline constexpr std::string_view growthCaution =
    "motion that nothing damps grows at every step: dt = \"auto\" keeps it to a factor of e in 10 s";

// Limits that two methods have in common [s]: Heun and midpoint, the same on linear problems, and leap-frog and
// velocity Verlet, whose positions are the same.
double heunLargestStep(const FastestMode& mode);
double heunAutomaticStep(const FastestMode& mode);
double leapfrogLargestStep(const FastestMode& mode);

}  // namespace taut::ode
