// Methods against the damped oscillator: exact solutions, order, and leap-frog against velocity Verlet.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/oscillator_measures.h"

namespace taut::test::oscillator_damping {
namespace {

constexpr double omega = 2.0;
constexpr Phase start{1.0, 0.7};

std::vector<Damping> dampings() {
    std::vector<Damping> all{{omega, 0.0, 0.0}};
    for (double zeta : {0.1, 0.5, 1.0, 2.0})
        for (double share : {0.0, 1.0, 0.4}) all.push_back({omega, zeta, share});
    return all;
}

TEST(DampedOscillator, EveryMethodFollowsTheExactSolution) {
    for (const Damping& damping : dampings())
        for (const ode::MethodInfo& method : ode::methods()) {
            SCOPED_TRACE(std::string(method.name) + ", " + damping.name());
            // h = 2.5e-4 s, ω h = 5e-4; order 4 would be lost in rounding there, and takes 20 times that, in six
            // evaluations 40 times.
            const int steps = method.evaluations == 6 ? 50 : method.order == 4 ? 100 : 2000;
            const PhaseError error = errorAgainstTheory(method.name, damping, steps);
            // Second order: at most (1 + 2ζ)² (ω h)²/4 a radian of phase, 10 radians: 2e-5. First order: ω h/2 a
            // radian, 3e-3; with drag taken implicitly, and c and γ apart, up to twice that. Fourth order: (λ h)⁴/120 a
            // radian with λ = 3.7 ω at ζ = 2, 2e-7. All far below the amplitude of 1, and not zero.
            const double most = method.order == 1 ? 6e-3 : method.order == 2 ? 2e-5 : 2e-7;
            EXPECT_LT(error.x, most);
            EXPECT_LT(error.v, omega * most);
            EXPECT_GT(error.x, 1e-12);
        }
}

// At ω h = 0.01 the next term of the error changes the exponent by a few hundredths: 0.1 is the tolerance on either
// side.
TEST(DampedOscillator, EveryMethodHasItsOrderWithDragWithDashpotsAndWithBoth) {
    for (const Damping& damping : dampings())
        for (const ode::MethodInfo& method : ode::methods()) {
            SCOPED_TRACE(std::string(method.name) + ", " + damping.name());
            // Order 4 takes ω h = 0.02, so as to stay clear of rounding.
            const int steps = method.order == 4 ? 50 : 200;
            const MeasuredOrder order = measuredOrder(method.name, damping, steps);
            EXPECT_NEAR(order.x, method.order, 0.1);
            EXPECT_NEAR(order.v, method.order, 0.1);
        }
}

// x'' = -x - 0.5 x³ + 0.8 cos t - 0.3 x' - 0.2 x': time, position and velocity all enter.
constexpr Oscillator::Values driven{1.0, 0.3, 0.2, 0.5, 0.8};

// Classical Runge-Kutta, written here so that the reference owes nothing to the methods under test.
Phase drivenReference(double t, int steps) {
    const auto slope = [](double s, Phase p) {
        return Phase{p.v, -p.x - 0.5 * p.x * p.x * p.x + 0.8 * std::cos(s) - 0.5 * p.v};
    };
    const auto moved = [](Phase p, double h, Phase d) { return Phase{p.x + h * d.x, p.v + h * d.v}; };
    const double h = t / steps;
    Phase p = start;
    for (int i = 0; i < steps; ++i) {
        const double s = t * i / steps;
        const Phase a = slope(s, p), b = slope(s + h / 2, moved(p, h / 2, a)), c = slope(s + h / 2, moved(p, h / 2, b)),
                    d = slope(s + h, moved(p, h, c));
        p = {p.x + h / 6 * (a.x + 2 * b.x + 2 * c.x + d.x), p.v + h / 6 * (a.v + 2 * b.v + 2 * c.v + d.v)};
    }
    return p;
}

TEST(DrivenOscillator, EveryMethodHasItsOrderWhenTheForceDependsOnTime) {
    const Phase ought = drivenReference(4.0, 4000);  // its own error is about 1e-13
    for (const ode::MethodInfo& method : ode::methods()) {
        SCOPED_TRACE(method.name);
        double x[2], v[2];
        for (int i = 0; i < 2; ++i) {
            Oscillator oscillator(driven);
            const int steps = (method.evaluations == 6 ? 80 : 800) << i;
            Integration<double> run = integrate(oscillator, method.name, 4.0 / steps, start);
            run.step(steps);
            x[i] = phaseOf(run).x - ought.x;
            v[i] = phaseOf(run).v - ought.v;
        }
        // As above: h = 5e-3; with six evaluations of order 4 0.05, clear of rounding.
        EXPECT_NEAR(std::log2(x[0] / x[1]), method.order, 0.1);
        EXPECT_NEAR(std::log2(v[0] / v[1]), method.order, 0.1);
    }
}

TEST(VelocityVerlet, GivesThePositionsAndVelocitiesOfLeapfrogWithDragAndDashpots) {
    std::vector<Oscillator::Values> cases{driven};
    for (const Damping& damping : dampings()) cases.push_back(damping.values());
    for (const Oscillator::Values& values : cases) {
        SCOPED_TRACE("dashpot " + std::to_string(values.dashpot) + ", drag " + std::to_string(values.drag));
        Oscillator one(values), other(values);
        Integration<double> leapfrog = integrate(one, "leapfrog", 0.02, start);
        Integration<double> verlet = integrate(other, "velocity-verlet", 0.02, start);
        for (int i = 0; i < 2000; ++i) {
            leapfrog.step();
            verlet.step();
            // Rounding: 2000 steps of a few 1e-16 each, in phase at worst: 1e-12.
            ASSERT_NEAR(leapfrog.state.x[0], verlet.state.x[0], 1e-12) << "after " << i + 1 << " steps";
            ASSERT_NEAR(phaseOf(leapfrog).v, phaseOf(verlet).v, 1e-12) << "after " << i + 1 << " steps";
        }
    }
}

}  // namespace
}  // namespace taut::test::oscillator_damping
