// The largest stable step of each method on the damped oscillator: bounded just below, growing just above.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/oscillator.h"

namespace taut::test {
namespace {

constexpr double omega = 5.0;
constexpr int manySteps = 200000;
constexpr double zetas[] = {0.0, 0.1, 0.5, 1.0, 2.0};

// How far the amplitude gets within many steps; stops beyond 1e12.
double largestAmplitude(std::string_view method, const Oscillator::Values& values, double h) {
    Oscillator oscillator(values);
    Integration<double> run = integrate(oscillator, method, h, {1.0, values.omega});
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
void expectLimit(std::string_view method, const Oscillator::Values& values, double limit) {
    EXPECT_LT(largestAmplitude(method, values, 0.99 * limit), 100.0);
    EXPECT_GT(largestAmplitude(method, values, 1.01 * limit), 1e11);
}

double leapfrogLimit(double zetaOfDashpot) {
    return 2.0 * (std::sqrt(1.0 + 4.0 * zetaOfDashpot * zetaOfDashpot) - 2.0 * zetaOfDashpot) / omega;
}
double eulerLimit(double zeta) {
    return (zeta < 1.0 ? 2.0 * zeta : 2.0 * (zeta - std::sqrt(zeta * zeta - 1.0))) / omega;
}

Oscillator::Values damped(double zetaOfDrag, double zetaOfDashpot) {
    return {omega, 2.0 * zetaOfDashpot * omega, 2.0 * zetaOfDrag * omega, 0.0, 0.0};
}

TEST(LeapfrogLimit, IsTwoWhateverTheDragAndFallsWithDashpots) {
    for (const char* method : {"leapfrog", "velocity-verlet"})
        for (double drag : zetas)
            for (double dashpot : zetas) {
                SCOPED_TRACE(std::string(method) + ", drag ζ = " + std::to_string(drag) +
                             ", dashpot ζ = " + std::to_string(dashpot));
                expectLimit(method, damped(drag, dashpot), leapfrogLimit(dashpot));
            }
}

TEST(ExplicitEulerLimit, GrowsWithDampingUpToOneAndFallsBeyond) {
    for (double zeta : zetas)
        for (double share : {0.0, 0.5, 1.0}) {
            SCOPED_TRACE("ζ = " + std::to_string(zeta) + ", dashpot share " + std::to_string(share));
            if (zeta > 0.0) {
                expectLimit("euler", damped(zeta * (1.0 - share), zeta * share), eulerLimit(zeta));
            } else {  // no step is small enough: 1 + z² a step at z = 0.02 gives e^40
                EXPECT_GT(largestAmplitude("euler", damped(0.0, 0.0), 0.02 / omega), 1e11);
            }
        }
}

TEST(DashpotAtFiveTimesCritical, IsStableWithinTheLimitOnly) {
    for (const char* method : {"leapfrog", "velocity-verlet"})
        expectLimit(method, damped(0.0, 5.0), leapfrogLimit(5.0));
    expectLimit("euler", damped(0.0, 5.0), eulerLimit(5.0));
}

// Formulas on both sides: 1e-12 is rounding.
TEST(LargestStep, IsTheLimitOfTheTheory) {
    for (double zeta : zetas) {
        SCOPED_TRACE("ζ = " + std::to_string(zeta));
        const ode::FastestMode byTau{omega, 2.0 * zeta / omega, 0.0, 0.0}, byRate{omega, 0.0, 2.0 * zeta * omega, 0.0},
            byBoth{omega, zeta / omega, zeta * omega, 0.0}, byDrag{omega, 0.0, 0.0, 2.0 * zeta * omega};
        for (const char* name : {"leapfrog", "velocity-verlet"}) {
            const auto largestStep = ode::findMethod(name)->largestStep;
            for (const ode::FastestMode& mode : {byTau, byRate, byBoth})
                EXPECT_NEAR(largestStep(mode) / leapfrogLimit(zeta), 1.0, 1e-12) << name;
            EXPECT_NEAR(largestStep(byDrag) * omega, 2.0, 1e-12) << name;
        }
        const auto largestStep = ode::findMethod("euler")->largestStep;
        for (const ode::FastestMode& mode : {byTau, byDrag}) EXPECT_NEAR(largestStep(mode), eulerLimit(zeta), 1e-12);
        // Wind and anchors may leave the fastest mode undamped, and Euler lives on damping.
        EXPECT_EQ(largestStep(byRate), 0.0);
        EXPECT_NEAR(largestStep(byBoth), std::min(eulerLimit(zeta / 2.0), eulerLimit(zeta)), 1e-12);
    }
}

TEST(LargestStep, OfAFreePointIsSetByItsDampingAlone) {
    const ode::FastestMode nothing, damper{0.0, 0.0, 8.0, 0.0};
    for (const ode::MethodInfo& method : ode::methods()) {
        SCOPED_TRACE(method.name);
        EXPECT_TRUE(std::isinf(method.largestStep(nothing)));
        // v' = -c v: the position drifts by v0/c; growth beyond the limit is by 1.01 a step at least.
        const double limit = method.largestStep(damper);
        const Oscillator::Values values{0.0, 8.0, 0.0, 0.0, 0.0};
        Oscillator below(values), above(values);
        Integration<double> calm = integrate(below, method.name, 0.99 * limit, {0.0, 1.0});
        Integration<double> wild = integrate(above, method.name, 1.01 * limit, {0.0, 1.0});
        calm.step(5000);
        wild.step(5000);
        EXPECT_LT(std::abs(phaseOf(calm).v), 1e-6);
        EXPECT_GT(std::abs(phaseOf(wild).v), 1e6);
    }
}

}  // namespace
}  // namespace taut::test
