// The order of each method on whole networks, where springs are not linear and dashpots, drag and wind act together.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mechanics/builders.h"
#include "mechanics/wind.h"
#include "support/network.h"

namespace taut::test {
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

std::unique_ptr<mechanics::ForceGenerator<double>> windOn(const Model& model) {
    // From behind and fast enough that no triangle meets it edge-on in the short run: there its force has a kink.
    mechanics::WindSettings settings;
    settings.gust = {0.5, 1.3, 2.0, 3};
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
std::pair<double, double> errorOf(const Model& model, bool windy, std::string_view method, int steps,
                                  const std::vector<double>& ought) {
    Network network(model, method, horizon / steps, gravity);
    if (windy) network.add(windOn(model), method, horizon / steps);
    network.step(steps);
    const std::vector<double> v = network.run().synchronisedVelocities();
    double x2 = 0.0, v2 = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        x2 += std::pow(network.run().state.x[i] - ought[i], 2);
        v2 += std::pow(v[i] - ought[v.size() + i], 2);
    }
    return {std::sqrt(x2 / model.pointCount()), std::sqrt(v2 / model.pointCount())};
}

// h halves from 1/3 ms (order 4: from 4/3 ms, clear of rounding): ω h = 0.06 (0.24) for the fastest motion and less, so
// that the exponent is true to some hundredths.
TEST(ClothOrder, IsThatOfTheMethodWithDashpotsDragAndWind) {
    struct Case {
        double tau, drag;
        bool windy;
    };
    for (const Case& c : {Case{0, 0, false}, Case{5e-3, 0, false}, Case{0, 2.0, false}, Case{5e-3, 2.0, false},
                          Case{5e-3, 2.0, true}}) {
        const Model model = clothIn(c.tau, c.drag);
        Network fine(model, "velocity-verlet", 1e-4, gravity);
        if (c.windy) fine.add(windOn(model), "velocity-verlet", 1e-4);
        std::vector<double> y(fine.run().state.x.begin(), fine.run().state.x.end());
        y.insert(y.end(), fine.run().state.v.begin(), fine.run().state.v.end());
        const std::vector<double> ought = reference(fine.system(), y, horizon, 4000);
        for (const ode::MethodInfo& method : ode::methods()) {
            // The wind's force has kinks (edge-on, and where the waves of gusts join) that lower order 4.
            if (c.windy && method.order == 4) continue;
            SCOPED_TRACE(std::string(method.name) + ", τ = " + std::to_string(c.tau) + ", drag " +
                         std::to_string(c.drag) + (c.windy ? ", wind" : ""));
            const int steps = method.order == 1 ? 4800 : method.order == 2 ? 600 : 150;
            const auto [x1, v1] = errorOf(model, c.windy, method.name, steps, ought);
            const auto [x2, v2] = errorOf(model, c.windy, method.name, 2 * steps, ought);
            EXPECT_NEAR(std::log2(x1 / x2), method.order, 0.1);
            EXPECT_NEAR(std::log2(v1 / v2), method.order, 0.1);
            EXPECT_LT(x1, 1e-3);
            EXPECT_GT(x2, 1e-11);  // above the reference's own error, 1e-14 by its 4000 steps
        }
    }
}

}  // namespace
}  // namespace taut::test
