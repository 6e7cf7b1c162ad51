// SDIRK2: motion too fast for its step dies out, on stiff ropes too, and it errs less than implicit Euler for the same
// solves. Its order, and that no step is too long for it, are in the tests of all methods.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "support/network.h"
#include "support/oscillator.h"
#include "taut/core/trig.h"

namespace taut::test::sdirk2 {
namespace {

using mechanics::Model;

// R(w) = (1 + (1 - 2γ) w)/(1 - γ w)² at w = i z: for z = 0.5, 5 and 1000 it shrinks by as much a step.
TEST(Sdirk2Oscillator, ShrinksByItsStabilityFunction) {
    constexpr double omega = 3.0;
    const double gamma = 1.0 - std::sqrt(0.5);
    for (double z : {0.5, 5.0, 1000.0}) {
        Oscillator oscillator({omega});
        Integration<double> run = integrate(oscillator, "sdirk2", z / omega, {1.0, 0.0});
        const std::complex<double> w(0.0, z), one(1.0);
        const std::complex<double> factor = (one + (1.0 - 2.0 * gamma) * w) / ((one - gamma * w) * (one - gamma * w));
        std::complex<double> ought(1.0);
        for (int n = 1; n <= 5; ++n) {
            run.step();
            ought *= factor;  // x - i v/ω
            EXPECT_NEAR(run.state.x[0], ought.real(), 1e-11) << z;
            EXPECT_NEAR(run.state.v[0] / omega, -ought.imag(), 1e-11) << z;
        }
    }
}

// A rope of 1e6 N/m whose held end is torn 1 cm off along it, falling: ω h = 1000 of the fastest motion, 75 of the
// slowest one along the rope. After 0.2 s its elongations are looked at mode by mode.
TEST(Sdirk2Rope, IsAsCalmAsImplicitEulersAfterAJerk) {
    constexpr int links = 20, steps = 12;
    constexpr double h = 1.0 / 60, stiffness = 1e6, omega = 1000 / h, link = 0.05;
    for (double g : {0.0, 9.81}) {
        Model model;
        for (int i = 0; i <= links; ++i)
            addPoint(model, {link * i - (i == 0 ? 0.01 : 0.0), 0, 0}, 4 * stiffness / (omega * omega), i == 0);
        for (int i = 0; i < links; ++i) addSpring(model, i, i + 1, stiffness, link);
        const auto modes = [&](const char* method) {
            Network network(model, method, h, {0, -g, 0});
            network.step(steps);
            const std::vector<dvec3> x = network.positions();
            std::vector<double> amplitudes;
            for (int j = 0; j < links; ++j) {
                double sum = 0.0;
                for (int i = 0; i < links; ++i) {
                    const auto a = static_cast<std::size_t>(i);
                    sum += (glm::length(x[a + 1] - x[a]) - link) * std::cos((i + 0.5) * (j + 0.5) * core::pi / links);
                }
                amplitudes.push_back(std::abs(2.0 / links * sum));
            }
            return amplitudes;
        };
        const std::vector<double> theirs = modes("implicit-euler"), ours = modes("sdirk2");
        // A step leaves |R(75 i)| = 0.06 of the slowest, 5e-15 of the jerk in all: nothing, like implicit Euler.
        for (std::size_t j = 0; j < ours.size(); ++j)
            EXPECT_LT(ours[j], 3.0 * theirs[j] + 1e-13) << "mode " << j + 1 << ", g = " << g;
    }
}

// A chain released sideways, steps of a picture's length: less than a third of the error.
TEST(Sdirk2Chain, ErrsFarLessThanImplicitEulerForTheSameSolves) {
    Model model;
    addPoint(model, {0, 0, 0}, 1.0, true);
    for (int i = 1; i <= 10; ++i) {
        addPoint(model, {0.08 * i, 0.06 * i, 0}, 0.01);
        addSpring(model, i - 1, i, 400.0, 0.1);
    }
    const auto endAfter = [&](const char* method, int steps) {
        Network network(model, method, 0.5 / steps, {0, -9.81, 0});
        network.step(steps);
        return network.position(10);
    };
    const dvec3 ought = endAfter("rk4", 20000);
    // One step of SDIRK2 makes two solves.
    const double theirs = glm::length(endAfter("implicit-euler", 60) - ought);
    const double ours = glm::length(endAfter("sdirk2", 30) - ought);
    EXPECT_LT(ours, theirs / 3.0) << ours << ' ' << theirs;
    EXPECT_GT(ours, 1e-5);
}

}  // namespace
}  // namespace taut::test::sdirk2
