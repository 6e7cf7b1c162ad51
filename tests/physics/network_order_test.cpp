// The order of each method on whole networks, where springs are not linear and dashpots, drag and wind act together.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/network.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/wind.h"

namespace taut::test::network_order {
namespace {

using mechanics::Model;

// A small cloth hung by its top row, blown at, pushed out of its plane, with dashpots and drag.
Model clothIn(double tau, double drag) {
    Model model = mechanics::buildCloth({.down = {0, -0.8, 0.6},
                                         .size = {0.4, 0.4},
                                         .cells = {4, 4},
                                         .material = {0.3, 40.0, 20.0, 4.0, tau, drag, {}}});
    hold(model, "top");
    for (std::size_t i = 5; i < model.velocities.size(); ++i) {
        const double s = static_cast<double>(i);
        model.velocities[i] = {0.2 * std::sin(s), 0.1 * std::cos(s), 0.3 * std::sin(2.0 * s)};
    }
    return model;
}

enum class Air { still, lifting, blowing };

// From behind, in gusts, fast enough to carry the cloth along: within the run triangles move as the air does, and the
// normal part of its speed against them changes sign. `lifting` leaves its drag out.
std::unique_ptr<mechanics::ForceGenerator<double>> windOn(const Model& model, Air air) {
    mechanics::WindSettings settings;
    settings.gust = {0.5, 1.3, 2.0, 3};
    if (air == Air::lifting) settings.drag = 0.0;
    return std::make_unique<mechanics::Wind<double>>(model.triangles, dvec3(0.5, 3.0, 4.0), settings);
}

// Classical Runge-Kutta on the first-order view: no method under test has a part in it.
std::vector<double> reference(ode::SecondOrderSystem<double>& system, std::vector<double> y, double t, int steps) {
    ode::FirstOrderView<double> view(system);
    const double h = t / steps;
    const std::size_t n = y.size();
    std::vector<double> k[4], moved(n);
    for (auto& slope : k) slope.assign(n, 0.0);
    constexpr double share[] = {0.0, 0.5, 0.5, 1.0};
    for (int s = 0; s < steps; ++s) {
        for (int stage = 0; stage < 4; ++stage) {
            for (std::size_t i = 0; i < n; ++i)
                moved[i] = y[i] + (stage > 0 ? share[stage] * h * k[stage - 1][i] : 0.0);
            view.derivative(t * s / steps + share[stage] * h, moved.data(), k[stage].data());
        }
        for (std::size_t i = 0; i < n; ++i) y[i] += h / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]);
    }
    return y;
}

constexpr double horizon = 0.2;  // [s]
const dvec3 gravity(0, -9.81, 0);

// RMS over all points, of positions and of velocities.
std::pair<double, double> errorOf(const Model& model, Air air, std::string_view method, int steps,
                                  const std::vector<double>& ought) {
    Network network(model, method, horizon / steps, gravity);
    if (air != Air::still) network.add(windOn(model, air), method, horizon / steps);
    network.step(steps);
    const std::vector<double> v = network.run().synchronisedVelocities();
    double x2 = 0.0, v2 = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        x2 += std::pow(network.run().state.x[i] - ought[i], 2);
        v2 += std::pow(v[i] - ought[v.size() + i], 2);
    }
    return {std::sqrt(x2 / model.pointCount()), std::sqrt(v2 / model.pointCount())};
}

std::vector<double> referenceFor(const Model& model, Air air, int steps) {
    Network fine(model, "velocity-verlet", 1e-4, gravity);
    if (air != Air::still) fine.add(windOn(model, air), "velocity-verlet", 1e-4);
    std::vector<double> y(fine.run().state.x.begin(), fine.run().state.x.end());
    y.insert(y.end(), fine.run().state.v.begin(), fine.run().state.v.end());
    return reference(fine.system(), y, horizon, steps);
}

// h halves from 1/3 ms (order 4: from 4/3 ms, clear of rounding): ω h = 0.06 (0.24) for the fastest motion and less, so
// that the exponent is true to some hundredths.
TEST(ClothOrder, IsThatOfTheMethodWithDashpotsDragAndWind) {
    struct Case {
        double tau, drag;
        Air air;
    };
    for (const Case& c : {Case{0, 0, Air::still}, Case{5e-3, 0, Air::still}, Case{0, 2.0, Air::still},
                          Case{5e-3, 2.0, Air::still}, Case{5e-3, 2.0, Air::lifting}, Case{5e-3, 2.0, Air::blowing}}) {
        const Model model = clothIn(c.tau, c.drag);
        const std::vector<double> ought = referenceFor(model, c.air, 4000);
        for (const ode::MethodInfo& method : ode::methods()) {
            if (c.air == Air::blowing && method.order == 4) continue;  // the test below
            SCOPED_TRACE(std::string(method.name) + ", τ = " + std::to_string(c.tau) + ", drag " +
                         std::to_string(c.drag) + ", air " + std::to_string(static_cast<int>(c.air)));
            const int steps = method.order == 1 ? 4800 : method.order == 2 ? 600 : method.evaluations == 6 ? 75 : 150;
            const auto [x1, v1] = errorOf(model, c.air, method.name, steps, ought);
            const auto [x2, v2] = errorOf(model, c.air, method.name, 2 * steps, ought);
            // With dashpots the leading term of Blanes and Moan's method is so small that the next one shows until
            // rounding does: from below its order stands as that of the others, from above half of one more.
            const double above = method.evaluations == 6 ? 0.5 : 0.1;
            for (const double order : {std::log2(x1 / x2), std::log2(v1 / v2)}) {
                EXPECT_GT(order, method.order - 0.1);
                EXPECT_LT(order, method.order + above);
            }
            EXPECT_LT(x1, 1e-3);
            EXPECT_GT(x2, 1e-11);  // above the reference's own error, 1e-14 by its 4000 steps
        }
    }
}

// The drag of air on a triangle goes with |u·n| u, which has a kink where the air moves along the triangle. A step
// across a kink in v' is off by h² times the jump of its slope, for any method: a method of order 4 falls to 2,
// with a factor that depends on where in the step the kink lies. The joins of gusts (noise.h) do no such harm: with
// lift alone, above, order 4 stands in the same gusts.
TEST(ClothOrder, IsTwoForMethodsOfOrderFourWhereDragCrossesEdgeOn) {
    const Model model = clothIn(5e-3, 2.0);
    const std::vector<double> ought = referenceFor(model, Air::blowing, 64000);
    for (const char* method : {"rk4", "blanes-moan"}) {
        SCOPED_TRACE(method);
        const auto error = [&](int steps) { return errorOf(model, Air::blowing, method, steps, ought).second; };
        // Long steps hide the kinks behind the error of smooth motion, ∝ h⁴; at 0.5 ms and less kinks lead. Over four
        // halvings their chances even out: measured 2.3 (velocities), bounded from both sides within the scatter.
        const double order = std::log2(error(400) / error(6400)) / 4.0;
        EXPECT_GT(order, 1.5);
        EXPECT_LT(order, 2.8);
        EXPECT_LT(error(400), 1e-5);  // of 10 m/s: nothing that a picture, or another method at that step, would show
    }
}

}  // namespace
}  // namespace taut::test::network_order
