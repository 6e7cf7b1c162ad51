// Points of a network that are moved by hand: exactly where their path says, at every stage, in every method.
#include <gtest/gtest.h>

#include <cmath>

#include "support/network.h"

namespace taut::test::led_points {
namespace {

using mechanics::Model;

// Point 0 runs on a circle, point 1 hangs on it by a spring and a dashpot, point 2 on point 1.
constexpr double k = 4.0, rest = 0.5, tau = 0.1, mass = 0.5, drag = 0.2, radius = 0.3, turn = 2.0;

dvec3 place(double t) {
    return radius * dvec3(std::sin(turn * t), 1.0 - std::cos(turn * t), 0.0);
}
dvec3 speed(double t) {
    return radius * turn * dvec3(std::cos(turn * t), std::sin(turn * t), 0.0);
}

Model chain() {
    Model model;
    addPoint(model, {5, 5, 5}, 1.0, true);  // overwritten at once
    addPoint(model, {0.5, -0.5, 0.1}, mass);
    addPoint(model, {0.5, -1.0, 0.2}, mass);
    model.dragRates = {0.0, drag, drag};
    addSpring(model, 0, 1, k, rest, tau);
    addSpring(model, 1, 2, k, rest, tau);
    return model;
}

struct Pair {
    dvec3 x1, x2, v1, v2;
};
Pair operator+(const Pair& a, const Pair& b) {
    return {a.x1 + b.x1, a.x2 + b.x2, a.v1 + b.v1, a.v2 + b.v2};
}
Pair operator*(double s, const Pair& a) {
    return {s * a.x1, s * a.x2, s * a.v1, s * a.v2};
}

// Classical Runge-Kutta on the two free points, written here.
Pair reference(double t, int steps) {
    // Along n = d/l, from the other end: k (l - L) + τ k w·n.
    const auto pull = [](const dvec3& d, const dvec3& w) {
        const double l = glm::length(d);
        return k * (l - rest + tau * glm::dot(w, d) / l) / l * d;
    };
    const auto slope = [&](double s, const Pair& y) {
        const dvec3 upper = pull(y.x1 - place(s), y.v1 - speed(s)), lower = pull(y.x2 - y.x1, y.v2 - y.v1);
        return Pair{y.v1, y.v2, (lower - upper) / mass - drag * y.v1, -lower / mass - drag * y.v2};
    };
    Pair y{{0.5, -0.5, 0.1}, {0.5, -1.0, 0.2}, dvec3(0.0), dvec3(0.0)};
    const double h = t / steps;
    for (int i = 0; i < steps; ++i) {
        const double s = t * i / steps;
        const Pair a = slope(s, y), b = slope(s + h / 2, y + h / 2 * a), c = slope(s + h / 2, y + h / 2 * b),
                   d = slope(s + h, y + h * c);
        y = y + h / 6 * (a + 2.0 * b + 2.0 * c + d);
    }
    return y;
}

TEST(LedPoints, ArePulledAlongTheirPathAndPullTheRestAtTheOrderOfTheMethod) {
    const Pair ought = reference(3.0, 6000);  // ω h = 2e-3: 1e-13
    for (const ode::MethodInfo& method : ode::methods()) {
        SCOPED_TRACE(method.name);
        double error[2];
        for (int i = 0; i < 2; ++i) {
            const int steps = (method.order == 4 ? 150 : 1200) << i;  // order 4: clear of rounding
            Network network(chain(), method.name, 3.0 / steps);
            network.lead(
                {{0}, [](double t, std::span<dvec3> x, std::span<dvec3> v) { x[0] = place(t), v[0] = speed(t); }},
                method.name, 3.0 / steps);
            for (int n = 0; n < steps; ++n) {
                network.step();
                // The time of the step's end, n h + h, may differ from (n + 1) h by a rounding.
                ASSERT_LT(glm::length(network.position(0) - place(network.time())), 1e-14);
                ASSERT_LT(glm::length(network.velocities()[0] - speed(network.time())), 2e-14);
            }
            error[i] = glm::length(network.position(2) - ought.x2);
        }
        // h = 2.5e-3 and 0.02: the next term changes the exponent by some hundredths.
        EXPECT_NEAR(std::log2(error[0] / error[1]), method.order, 0.1);
        EXPECT_LT(error[0], 0.01);
    }
}

// A point that is led along no path but its own place is a held one, bit for bit.
TEST(LedPoints, ThatStayAreHeldPoints) {
    for (const ode::MethodInfo& method : ode::methods()) {
        Model model = chain();
        model.positions[0] = {0.1, 0.2, 0.3};
        Network held(model, method.name, 1e-2), led(model, method.name, 1e-2);
        led.lead({{0},
                  [](double, std::span<dvec3> x, std::span<dvec3> v) {
                      x[0] = {0.1, 0.2, 0.3}, v[0] = dvec3(0.0);
                  }},
                 method.name, 1e-2);
        held.step(100);
        led.step(100);
        EXPECT_EQ(held.positions(), led.positions()) << method.name;
    }
}

}  // namespace
}  // namespace taut::test::led_points
