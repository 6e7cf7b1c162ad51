// The largest stable step of each method on the damped oscillator: bounded just below, growing just above.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "support/oscillator_measures.h"

namespace taut::test::oscillator_limits {
namespace {

constexpr double omega = 5.0;
constexpr double zetas[] = {0.0, 0.1, 0.5, 1.0, 2.0};

double leapfrogLimit(double zetaOfDashpot) {
    return 2.0 * (std::sqrt(1.0 + 4.0 * zetaOfDashpot * zetaOfDashpot) - 2.0 * zetaOfDashpot) / omega;
}
// Explicit damping.
double symplecticEulerLimit(double zetaOfDrag, double zetaOfDashpot) {
    const double zeta = zetaOfDashpot - zetaOfDrag;
    return 2.0 * (std::sqrt(1.0 + zeta * zeta) - zeta) / omega;
}
double heunLimit(double zeta) {
    if (zeta >= 1.0) return 2.0 * (zeta - std::sqrt(zeta * zeta - 1.0)) / omega;
    double low = 0.0, high = 3.0;  // z³/4 - ζz² + 2ζ²z - 2ζ rises through its root
    for (int i = 0; i < 100; ++i) {
        const double z = 0.5 * (low + high);
        (z * z * z / 4 - zeta * z * z + 2 * zeta * zeta * z - 2 * zeta < 0.0 ? low : high) = z;
    }
    return low / omega;
}
// Where the complex R(w) = 1 + w + w²/2 + w³/6 + w⁴/24 leaves the unit circle, found by small steps.
double rk4Limit(double zeta) {
    if (zeta >= 1.0) return 2.785294 * (zeta - std::sqrt(zeta * zeta - 1.0)) / omega;
    const std::complex<double> direction(-zeta, std::sqrt(1.0 - zeta * zeta));
    double z = 2.0;
    for (; z < 4.0; z += 1e-5) {
        const std::complex<double> w = z * direction;
        if (std::abs(1.0 + w * (1.0 + w / 2.0 * (1.0 + w / 3.0 * (1.0 + w / 4.0)))) > 1.0) break;
    }
    return z / omega;
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
            if (zeta > 0.0)
                expectLimit("euler", damped(zeta * (1.0 - share), zeta * share), eulerLimit(zeta));
            else  // no step is small enough: 1 + z² a step at z = 0.02 gives e^40
                EXPECT_GT(largestAmplitude("euler", damped(0.0, 0.0), 0.02 / omega), 1e11);
        }
}

TEST(SymplecticEulerLimit, FallsWithDashpotsAndRisesWithDrag) {
    for (double drag : zetas)
        for (double dashpot : zetas) {
            SCOPED_TRACE("drag ζ = " + std::to_string(drag) + ", dashpot ζ = " + std::to_string(dashpot));
            expectLimit("symplectic-euler", damped(drag, dashpot), symplecticEulerLimit(drag, dashpot));
        }
}

// Undamped they have none: at z = 0.1 they grow by 1 + z⁴/8 a step, e^2.5 in 2e5 steps; at half of that by e^0.16.
TEST(HeunLimit, AndThatOfTheMidpointMethodIsTheRootOfTheCubic) {
    for (const char* method : {"heun", "midpoint"})
        for (double zeta : zetas)
            for (double share : {0.0, 0.5, 1.0}) {
                SCOPED_TRACE(std::string(method) + ", ζ = " + std::to_string(zeta) + ", share " +
                             std::to_string(share));
                if (zeta > 0.0) {
                    expectLimit(method, damped(zeta * (1.0 - share), zeta * share), heunLimit(zeta));
                    continue;
                }
                // From x = 1 and v = ω: an amplitude of √2. The growth to a few per cent of the exponent: z⁶ terms.
                for (double z : {0.05, 0.1}) {
                    const double grown = largestAmplitude(method, damped(0.0, 0.0), z / omega) / std::sqrt(2.0);
                    EXPECT_NEAR(std::log(grown) / (manySteps * z * z * z * z / 8.0), 1.0, 0.03);
                }
            }
}

TEST(RungeKutta4Limit, IsTheEdgeOfItsStabilityRegion) {
    for (double zeta : zetas)
        for (double share : {0.0, 0.5, 1.0}) {
            SCOPED_TRACE("ζ = " + std::to_string(zeta) + ", dashpot share " + std::to_string(share));
            expectLimit("rk4", damped(zeta * (1.0 - share), zeta * share), rk4Limit(zeta));
        }
    EXPECT_NEAR(rk4Limit(0.0) * omega, 2.0 * std::sqrt(2.0), 2e-5);  // the step of the search
}

TEST(ImplicitLimit, IsNone) {
    for (const char* method : {"implicit-euler", "sdirk2"})
        for (double zeta : zetas)
            for (double z : {0.1, 2.0, 100.0, 1e6}) {
                // The amplitude falls at every step; the start may be enlarged once.
                EXPECT_LT(largestAmplitude(method, damped(0.0, zeta), z / omega), 2.0) << zeta << ", " << z;
                EXPECT_TRUE(std::isinf(ode::findMethod(method)->largestStep({omega, 2.0 * zeta / omega})));
            }
}

// Half the trace of a step of S6 on undamped motion, from the coefficients alone: at -1 it first leaves the range in
// which the roots lie on the unit circle.
double halfTrace(double z) {
    const long double a[] = {0.0792036964311957L, 0.353172906049774L, -0.0420650803577195L},
                      b[] = {0.209515106613362L, -0.143851773179818L};
    const long double middle = 1 - 2 * (a[0] + a[1] + a[2]), third = 0.5L - b[0] - b[1];
    const long double kicks[] = {a[0], a[1], a[2], middle, a[2], a[1], a[0]};
    const long double drifts[] = {b[0], b[1], third, third, b[1], b[0], 0};
    long double trace = 0;
    for (int column = 0; column < 2; ++column) {
        long double x = 1 - column, v = column;
        for (int i = 0; i < 7; ++i) v -= kicks[i] * z * x, x += drifts[i] * z * v;
        trace += column == 0 ? x : v;
    }
    return static_cast<double>(trace / 2);
}

TEST(BlanesMoanLimit, IsTheTraceOfItsStepUndamped) {
    const ode::MethodInfo& method = *ode::findMethod("blanes-moan");
    const double limit = method.largestStep({omega}) * omega;
    EXPECT_NEAR(halfTrace(limit), -1.0, 1e-10);  // the conditions grant rounding 1e-11
    EXPECT_LT(halfTrace(limit + 1e-4), -1.0);
    for (double z = 0.01; z < limit - 1e-6; z += 0.01) ASSERT_GT(halfTrace(z), -1.0) << z;
    // Growth there is slow, and not beyond 3.16: below and above by 0.4 % each, over 2e5 steps.
    EXPECT_LT(largestAmplitude("blanes-moan", damped(0.0, 0.0), 0.996 * limit / omega), 100.0);
    EXPECT_GT(largestAmplitude("blanes-moan", damped(0.0, 0.0), 1.004 * limit / omega), 1e11);
    EXPECT_NEAR(method.automaticStep({omega}) / method.largestStep({omega}), 1.0, 1e-8);  // its constant's digits
}

// With damping of either kind the first root that leaves the circle, measured.
TEST(BlanesMoanLimit, FollowsDampingFromBothSidesAndAutoDoesNotRiseByIt) {
    const ode::MethodInfo& method = *ode::findMethod("blanes-moan");
    for (double zeta : {0.02, 0.1, 0.3, 0.5, 1.0, 1.19, 1.3, 2.0, 5.0, 50.0})
        for (double share : {0.0, 0.5, 1.0}) {
            SCOPED_TRACE("ζ = " + std::to_string(zeta) + ", dashpot share " + std::to_string(share));
            const ode::FastestMode mode{omega, 2 * zeta * share / omega, 0.0, 2 * zeta * (1 - share) * omega,
                                        2 * zeta * (1 - share) * omega};
            const double limit = method.largestStep(mode);
            expectLimit("blanes-moan", damped(zeta * (1.0 - share), zeta * share), limit);
            EXPECT_LE(method.automaticStep(mode), std::min(limit, method.largestStep({omega})) * (1 + 1e-9));
            EXPECT_GE(method.automaticStep(mode), std::min(limit, method.largestStep({omega})) * (1 - 1e-6));
        }
}

TEST(DashpotAtFiveTimesCritical, IsStableWithinTheLimitOnly) {
    for (const char* method : {"leapfrog", "velocity-verlet"})
        expectLimit(method, damped(0.0, 5.0), leapfrogLimit(5.0));
    expectLimit("symplectic-euler", damped(0.0, 5.0), symplecticEulerLimit(0.0, 5.0));
    expectLimit("euler", damped(0.0, 5.0), eulerLimit(5.0));
    for (const char* method : {"heun", "midpoint"}) expectLimit(method, damped(0.0, 5.0), heunLimit(5.0));
    expectLimit("rk4", damped(0.0, 5.0), rk4Limit(5.0));
    for (const char* method : {"implicit-euler", "sdirk2"})
        EXPECT_LT(largestAmplitude(method, damped(0.0, 5.0), 1e3 / omega), 2.0);
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
        for (const ode::FastestMode& mode : {byTau, byDrag}) {
            EXPECT_NEAR(ode::findMethod("heun")->largestStep(mode), heunLimit(zeta), 1e-12);
            EXPECT_NEAR(ode::findMethod("midpoint")->largestStep(mode), heunLimit(zeta), 1e-12);
            EXPECT_NEAR(ode::findMethod("rk4")->largestStep(mode), rk4Limit(zeta), 2e-5);  // the step of the search
        }
        for (const ode::FastestMode& mode : {byTau, byRate, byBoth})
            EXPECT_NEAR(ode::findMethod("symplectic-euler")->largestStep(mode), symplecticEulerLimit(0.0, zeta), 1e-12);
        EXPECT_NEAR(ode::findMethod("symplectic-euler")->largestStep(byDrag), symplecticEulerLimit(zeta, 0.0), 1e-12);
        const auto largestStep = ode::findMethod("euler")->largestStep;
        for (const ode::FastestMode& mode : {byTau, byDrag}) EXPECT_NEAR(largestStep(mode), eulerLimit(zeta), 1e-12);
        // Wind and anchors may leave the fastest mode undamped, and Euler lives on damping.
        EXPECT_EQ(largestStep(byRate), 0.0);
        EXPECT_NEAR(largestStep(byBoth), std::min(eulerLimit(zeta / 2.0), eulerLimit(zeta)), 1e-12);
    }
}

// Without damping no step of Heun's is stable for ever: the automatic one lets motion grow e-fold in 10 s, no faster,
// and is a share of the stable one as soon as dashpots allow.
TEST(AutomaticStep, OfHeunLetsUndampedMotionGrowSlowly) {
    for (const char* name : {"heun", "midpoint"})
        for (double frequency : {50.0, 3000.0}) {
            const ode::MethodInfo& method = *ode::findMethod(name);
            const double h = method.automaticStep({frequency});
            Oscillator oscillator({frequency});
            Integration<double> run = integrate(oscillator, name, h, {1.0, 0.0});
            double late = 0.0;
            const auto steps = static_cast<std::int64_t>(10.0 / h);
            for (std::int64_t i = 0; i < steps; ++i) {
                run.step();
                if (i > steps - 200) late = std::max(late, std::abs(run.state.x[0]));
            }
            EXPECT_NEAR(std::log(late), 1.0, 0.1) << name;  // z⁶ terms, and the peak within 200 samples
            // Dashpots: never over their limit, never below the step without them.
            for (double tau : {1e-7, 1e-5, 1e-3, 0.1}) {
                const ode::FastestMode mode{frequency, tau};
                EXPECT_LE(method.automaticStep(mode), std::max(method.largestStep(mode), h)) << name << ", τ " << tau;
                EXPECT_GE(method.automaticStep(mode), std::min(method.largestStep(mode), h)) << name << ", τ " << tau;
            }
        }
}

TEST(LargestStep, OfAFreePointIsSetByItsDampingAlone) {
    const ode::FastestMode nothing, damper{0.0, 0.0, 8.0, 0.0};
    for (const ode::MethodInfo& method : ode::methods()) {
        SCOPED_TRACE(method.name);
        EXPECT_TRUE(std::isinf(method.largestStep(nothing)));
        // v' = -c v: the position drifts by v0/c; growth beyond the limit is by 1.01 a step at least.
        const double limit = method.largestStep(damper);
        if (method.name == "symplectic-euler") EXPECT_DOUBLE_EQ(limit, 0.25);
        const bool isImplicit = method.name == "implicit-euler" || method.name == "sdirk2";
        EXPECT_EQ(std::isinf(limit), isImplicit);
        if (isImplicit) continue;
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
}  // namespace taut::test::oscillator_limits
