// Measures of a method on the damped oscillator: its error against the exact solution, from which its order
// follows, and its largest stable step.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "support/oscillator.h"

namespace taut::test {

// The frequency [1/s], the damping ratio, and how much of the damping is a dashpot.
struct Damping {
    double omega = 1.0, zeta = 0.0, dashpotShare = 0.0;

    Oscillator::Values values() const {
        const double rate = 2.0 * zeta * omega;
        return {omega, dashpotShare * rate, (1.0 - dashpotShare) * rate, 0.0, 0.0};
    }
    std::string name() const {
        return "ζ = " + std::to_string(zeta) + ", dashpot share " + std::to_string(dashpotShare);
    }
};

struct PhaseError {
    double x = 0.0, v = 0.0;  // RMS over ten looks within 5 s
};

inline PhaseError errorAgainstTheory(std::string_view method, const Damping& damping, int stepsPerLook,
                                     const ode::Methods& methods = ode::builtInMethods()) {
    constexpr Phase start{1.0, 0.7};
    constexpr double horizon = 5.0;  // [s]
    constexpr int looks = 10;
    Oscillator oscillator(damping.values());
    Integration<double> run =
        integrate(oscillator, method, horizon / (looks * stepsPerLook), start, exactSolves, methods);
    PhaseError error;
    for (int i = 1; i <= looks; ++i) {
        run.step(stepsPerLook);
        const Phase is = phaseOf(run), ought = exactOscillation(damping.omega, damping.zeta, start, run.time());
        error.x += (is.x - ought.x) * (is.x - ought.x) / looks;
        error.v += (is.v - ought.v) * (is.v - ought.v) / looks;
    }
    return {std::sqrt(error.x), std::sqrt(error.v)};
}

// The error falls by 2^order when h is halved.
struct MeasuredOrder {
    double x, v;
};
inline MeasuredOrder measuredOrder(std::string_view method, const Damping& damping, int stepsPerLook,
                                   const ode::Methods& methods = ode::builtInMethods()) {
    const PhaseError coarse = errorAgainstTheory(method, damping, stepsPerLook, methods);
    const PhaseError fine = errorAgainstTheory(method, damping, 2 * stepsPerLook, methods);
    return {std::log2(coarse.x / fine.x), std::log2(coarse.v / fine.v)};
}

inline constexpr int manySteps = 200000;

// How far the amplitude gets within many steps; stops beyond 1e12.
inline double largestAmplitude(std::string_view method, const Oscillator::Values& values, double h,
                               const ode::Methods& methods = ode::builtInMethods()) {
    Oscillator oscillator(values);
    Integration<double> run = integrate(oscillator, method, h, {1.0, values.omega}, exactSolves, methods);
    double largest = 0.0;
    for (int i = 0; i < manySteps && largest < 1e12; ++i) {
        run.step();
        largest = std::max(largest, std::abs(run.state.x[0]));
    }
    return largest;
}

// Below the limit the start can be enlarged once: 1/√(1 - 0.99²) = 7 times for either part of it; where two roots
// meet, Euler at ζ = 1, n steps multiply it by 4 n 0.98^n, 73 at most. Never more than 100, that is.
// Above it the slowest growth here, Euler at ζ = 0.1, is (1 + 0.04 ζ²)^(n/2) = e^40 in n = 2e5 steps.
inline void expectLimit(std::string_view method, const Oscillator::Values& values, double limit,
                        const ode::Methods& methods = ode::builtInMethods()) {
    EXPECT_LT(largestAmplitude(method, values, 0.99 * limit, methods), 100.0);
    EXPECT_GT(largestAmplitude(method, values, 1.01 * limit, methods), 1e11);
}

}  // namespace taut::test
