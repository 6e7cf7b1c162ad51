// Energy and frequency of the undamped oscillator, where theory knows every step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/oscillator.h"

namespace taut::test::oscillator_energy {
namespace {

constexpr double omega = 3.0;
constexpr Phase start{1.0, 0.0};

// z = ω h
Integration<double> undamped(Oscillator& oscillator, const char* method, double z, Phase from = start) {
    return integrate(oscillator, method, z / omega, from);
}

double energyOf(Phase p) {
    return 0.5 * p.v * p.v + 0.5 * omega * omega * p.x * p.x;
}

TEST(LeapfrogOscillator, ConservesItsOwnEnergyToRounding) {
    for (const char* method : {"leapfrog", "velocity-verlet"})
        for (double z : {0.1, 0.5, 1.0, 1.9}) {
            SCOPED_TRACE(std::string(method) + ", z = " + std::to_string(z));
            Oscillator oscillator({omega});
            Integration<double> run = undamped(oscillator, method, z, {1.0, 0.4 * omega});
            // ½ v_n² + ½ ω² (1 - z²/4) x²
            const auto shadow = [&] {
                const Phase p = phaseOf(run);
                return 0.5 * p.v * p.v + 0.5 * omega * omega * (1.0 - z * z / 4.0) * p.x * p.x;
            };
            const double first = shadow();
            double worst = 0.0;
            for (int i = 0; i < 100000; ++i) {
                run.step();
                worst = std::max(worst, std::abs(shadow() / first - 1.0));
            }
            // 1e5 steps of 1e-16, mostly as a random walk, ten times enlarged at z = 1.9: 1e-12 at most.
            EXPECT_LT(worst, 1e-11);
        }
}

TEST(LeapfrogOscillator, EnergySwingsByAQuarterOfZSquaredWithoutTrend) {
    for (const char* method : {"leapfrog", "velocity-verlet"}) {
        SCOPED_TRACE(method);
        constexpr double z = 0.2;
        constexpr int steps = 100000;
        Oscillator oscillator({omega});
        Integration<double> run = undamped(oscillator, method, z);
        double low = HUGE_VAL, high = 0.0, slope = 0.0, weight = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double energy = energyOf(phaseOf(run));
            low = std::min(low, energy);
            high = std::max(high, energy);
            const double s = (i + 0.5) / steps - 0.5;  // regression on the share of the run
            slope += s * energy;
            weight += s * s;
            run.step();
        }
        // From E to E/(1 - z²/4); the extremes are hit within (1e-3)², there being 1e5 samples.
        EXPECT_NEAR(high / low - 1.0, (z * z / 4) / (1.0 - z * z / 4), 1e-6);
        // The swing of 1 % of the energy averages out over 3200 periods: 1e-2/3200 = 3e-6 of it is left.
        EXPECT_LT(std::abs(slope / weight), 1e-5 * low);
    }
}

TEST(LeapfrogOscillator, SwingsAtItsDiscreteFrequency) {
    for (const char* method : {"leapfrog", "velocity-verlet"})
        for (double z : {0.01, 0.3, 1.0, 1.9}) {
            SCOPED_TRACE(std::string(method) + ", z = " + std::to_string(z));
            Oscillator oscillator({omega});
            Integration<double> run = undamped(oscillator, method, z);
            const double angle = 2.0 * std::asin(z / 2);  // ω_h h
            for (int i = 1; i <= 10000; ++i) {
                run.step();
                // Rounding enters the phase: 1e4 steps of 1e-16, enlarged 1/√(1 - z²/4) times and by i: below 1e-9.
                ASSERT_NEAR(run.state.x[0], std::cos(i * angle), 1e-9) << "after " << i << " steps";
            }
        }
}

TEST(ExplicitEulerOscillator, GrowsAtItsKnownRate) {
    constexpr double z = 0.05;
    Oscillator oscillator({omega});
    Integration<double> run = undamped(oscillator, "euler", z);
    for (int i = 1; i <= 2000; ++i) {
        run.step();
        // x_n = Re (1 - i z)^n
        const double amplitude = std::pow(1.0 + z * z, 0.5 * i);
        ASSERT_NEAR(run.state.x[0], amplitude * std::cos(i * std::atan(z)), 1e-11 * amplitude) << "after " << i;
        // The energy grows by 1 + z² each step, at any phase.
        ASSERT_NEAR(energyOf(phaseOf(run)), energyOf(start) * amplitude * amplitude, 1e-11 * amplitude * amplitude)
            << "after " << i;  // rounding: 2000 steps of 1e-15
    }
}

TEST(LeapfrogOscillator, GoesBackWhereItCameFrom) {
    for (const char* method : {"leapfrog", "velocity-verlet"}) {
        SCOPED_TRACE(method);
        Oscillator oscillator({1.0, 0.0, 0.0, 0.7, 0.0});
        Integration<double> run = integrate(oscillator, method, 0.05, {1.0, 0.3});
        run.step(500);
        EXPECT_GT(std::abs(run.state.x[0] - 1.0), 0.01);  // it went somewhere
        run.reverse();
        run.step(500);
        const Phase back = phaseOf(run);
        // Rounding of 1000 steps, not bitwise.
        EXPECT_NEAR(back.x, 1.0, 1e-12);
        EXPECT_NEAR(back.v, -0.3, 1e-12);
    }
}

}  // namespace
}  // namespace taut::test::oscillator_energy
