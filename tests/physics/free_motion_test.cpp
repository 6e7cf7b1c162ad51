// Motion without supports: falling, drag, flight, and independence of the observer.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "support/network.h"
#include "taut/mechanics/builders.h"

namespace taut::test::free_motion {
namespace {

using mechanics::Model;

constexpr double g = 9.81;
const dvec3 gravity(0, -g, 0);

Model onePoint(dvec3 velocity, double mass, double dragRate) {
    Model model;
    addPoint(model, {0.5, 2.0, -1.0}, mass);
    model.velocities[0] = velocity;
    model.dragRates[0] = dragRate;
    return model;
}

TEST(FreeFall, IsExactForMethodsOfOrderTwoAndMore) {
    const Model model = onePoint({1.0, 3.0, -0.5}, 0.7, 0.0);
    for (const ode::MethodInfo& info : ode::methods()) {
        if (info.order < 2) continue;
        const std::string_view method = info.name;
        Network network(model, method, 0.01, gravity);
        network.step(300);
        const double t = 3.0;
        const dvec3 x = model.positions[0] + t * model.velocities[0] + 0.5 * t * t * gravity;
        const dvec3 v = model.velocities[0] + t * gravity;
        // 300 roundings of numbers up to 40: 1e-12.
        EXPECT_LT(glm::length(network.position(0) - x), 1e-12) << method;
        EXPECT_LT(glm::length(network.velocities()[0] - v), 1e-12) << method;
    }
}

TEST(FreeFall, OfExplicitEulerLagsByHalfAStepOfItsSpeedAndOfTheOtherEulersLeads) {
    const Model model = onePoint({1.0, 3.0, -0.5}, 0.7, 0.0);
    constexpr double h = 0.01, t = 3.0;
    const dvec3 x = model.positions[0] + t * model.velocities[0] + 0.5 * t * t * gravity;
    for (auto [method, side] : {std::pair("euler", -1.0), {"symplectic-euler", 1.0}, {"implicit-euler", 1.0}}) {
        Network network(model, method, h, gravity);
        network.step(300);
        // x_n = x ∓ ½ g h t; rounding as above.
        EXPECT_LT(glm::length(network.position(0) - (x + side * 0.5 * h * t * gravity)), 1e-12) << method;
    }
}

// x = (v0/γ)(1 - e^{-γt}), γ the rate: the order from the error at h and h/2, where γ h = 0.01: ±0.1.
TEST(LinearDrag, SlowsAPointAtTheOrderOfTheMethod) {
    constexpr double rate = 2.0, t = 1.5;
    const Model model = onePoint({4.0, 0.0, 0.0}, 0.3, rate);
    for (const ode::MethodInfo& method : ode::methods()) {
        double error[2];
        for (int i = 0; i < 2; ++i) {
            const int steps = 300 << i;
            Network network(model, method.name, t / steps);
            network.step(steps);
            error[i] = network.position(0).x - (0.5 + 4.0 / rate * (1.0 - std::exp(-rate * t)));
        }
        EXPECT_NEAR(std::log2(error[0] / error[1]), method.order, 0.1) << method.name;
        EXPECT_LT(std::abs(error[0]), method.order == 1 ? 0.02 : 1e-4) << method.name;  // γ h v0/γ, (γ h)² v0/γ
    }
}

TEST(LinearDrag, EndsAtTheTerminalSpeed) {
    constexpr double rate = 4.0;
    for (const ode::MethodInfo& method : ode::methods()) {
        Network network(onePoint({2.0, 5.0, 0.0}, 0.3, rate), method.name, 0.01, gravity);
        network.step(1500);  // e^{-60} of the start is left
        const dvec3 v = network.velocities()[0];
        EXPECT_NEAR(v.y, -g / rate, 1e-12) << method.name;  // m g/γ; rounding
        EXPECT_NEAR(v.x, 0.0, 1e-12) << method.name;
    }
}

// A deformed, spinning bundle of springs, some damped.
Model bundle() {
    Model model;
    const dvec3 places[] = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 1.1, 0}, {0.1, 0.3, 0.9}, {1, 1, 1}, {0.5, -0.6, 0.4}};
    for (int i = 0; i < 6; ++i) {
        addPoint(model, places[i], 0.1 + 0.07 * i);
        model.velocities.back() = {0.3 + 0.4 * places[i].z, 1.0 - 0.2 * i, -2.0 * places[i].x};
    }
    for (int a = 0; a < 6; ++a)
        for (int b = a + 1; b < 6; ++b)
            addSpring(model, a, b, 20.0 + 5.0 * a, 0.9 * glm::length(places[b] - places[a]), a % 2 == 0 ? 1e-3 : 0.0);
    return model;
}

TEST(FreeFlight, KeepsMomentumAndAngularMomentum) {
    for (const char* method : {"leapfrog", "velocity-verlet", "symplectic-euler"}) {
        Network network(bundle(), method, 5e-3);
        const dvec3 momentum = network.momentum(), turn = network.angularMomentum();
        ASSERT_GT(glm::length(turn), 0.1);
        for (int i = 0; i < 10; ++i) {
            network.step(1000);
            // 1e4 steps of rounding: 1e-16 times momenta of 1, and of lever arms that grow to 50 m in the flight.
            EXPECT_LT(glm::length(network.momentum() - momentum), 1e-12) << method;
            EXPECT_LT(glm::length(network.angularMomentum() - turn), 1e-10) << method;
        }
    }
}

TEST(FreeFlight, OfOtherMethodsKeepsMomentumButNotAngularMomentum) {
    for (const char* method : {"euler", "heun", "midpoint", "rk4", "implicit-euler"}) {
        Network network(bundle(), method, 5e-4);
        const dvec3 momentum = network.momentum(), turn = network.angularMomentum();
        network.step(1000);
        // Rounding; of the solver of implicit Euler 1e-13 of each change.
        EXPECT_LT(glm::length(network.momentum() - momentum), 1e-12) << method;
        // Euler leaves Σ m v×a h² a step, the others the next power or two of h: more than rounding by far.
        const bool isRough = method == std::string_view("euler") || method == std::string_view("implicit-euler");
        const double left = glm::length(network.angularMomentum() - turn);
        EXPECT_GT(left, isRough ? 1e-6 : 1e-12) << method;
        EXPECT_LT(left, isRough ? 1e-1 : 1e-4) << method;
    }
}

TEST(FreeFlight, OfANetAtRestLeavesItUndeformed) {
    const Model cloth = mechanics::buildCloth({.origin = {0.3, 5, -0.2},
                                               .down = {0, 0, 1},
                                               .size = {0.9, 0.6},
                                               .cells = {9, 6},
                                               .material = {0.2, 900, 450, 5, 1e-4, 0.4, {}}});
    for (const ode::MethodInfo& method : ode::methods()) {
        Network network(cloth, method.name, 5e-5, gravity);  // within Euler's limit too, τ
        network.step(10000);
        const dvec3 fall = network.position(0) - cloth.positions[0];
        EXPECT_NEAR(fall.y, -0.5 * g * 0.25, 0.1) << method.name;  // it fell: drag takes 7 % off
        for (int i = 0; i < cloth.pointCount(); ++i)
            // Rounding of positions of 5 m, 1e-15, strains springs; 1e4 steps of it: below 1e-11.
            ASSERT_LT(glm::length(network.position(i) - cloth.positions[i] - fall), 1e-11)
                << method.name << ", point " << i;
    }
}

TEST(FreeFlight, LooksTheSameToAMovingObserver) {
    const dvec3 wind(3.0, -1.0, 2.0);
    for (const ode::MethodInfo& method : ode::methods()) {
        Model moving = bundle();
        for (dvec3& v : moving.velocities) v += wind;
        Network network(bundle(), method.name, 1e-3), other(moving, method.name, 1e-3);
        network.step(1000);
        other.step(1000);
        for (int i = 0; i < moving.pointCount(); ++i)
            // Rounding grows with the motion of the bundle, which is not chaotic within a second: 1e-12 m.
            EXPECT_LT(glm::length(other.position(i) - network.position(i) - 1.0 * wind), 1e-11) << method.name;
    }
}

TEST(FreeFlight, LooksTheSameToATurnedObserver) {
    const glm::dquat turn = glm::normalize(glm::dquat(0.8, 0.3, -0.4, 0.2));
    for (const ode::MethodInfo& method : ode::methods()) {
        Model turned = bundle();
        for (dvec3& x : turned.positions) x = turn * x;
        for (dvec3& v : turned.velocities) v = turn * v;
        Network network(bundle(), method.name, 1e-3), other(turned, method.name, 1e-3);
        network.step(1000);
        other.step(1000);
        for (int i = 0; i < turned.pointCount(); ++i)
            EXPECT_LT(glm::length(other.position(i) - turn * network.position(i)), 1e-11) << method.name;  // as above
    }
}

// An undamped cloth held at two corners: it swings, folds, and finds its way back.
TEST(Reversal, BringsAClothBackAfterFiveHundredSteps) {
    Model cloth = mechanics::buildCloth(
        {.down = {0, 0, 1}, .size = {1, 1}, .cells = {8, 8}, .material = {0.2, 300, 150, 1, 0.0, 0.0, {}}});
    hold(cloth, "top-left");
    hold(cloth, "top-right");
    for (const char* method : {"leapfrog", "velocity-verlet"}) {
        Network network(cloth, method, 1e-3, gravity);
        network.step(500);
        EXPECT_GT(glm::length(network.position(80) - cloth.positions[80]), 0.5) << method;
        network.run().reverse();
        network.step(500);
        for (int i = 0; i < cloth.pointCount(); ++i)
            // 1000 steps of rounding, enlarged by the folding cloth.
            EXPECT_LT(glm::length(network.position(i) - cloth.positions[i]), 1e-9) << method;
    }
}

}  // namespace
}  // namespace taut::test::free_motion
