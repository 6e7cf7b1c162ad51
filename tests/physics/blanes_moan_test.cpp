// Blanes and Moan's method of order 4: no drift of energy over long runs, and its place among the others at equal cost.
// Its order, with and without damping, and its limits are in the tests of all methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/network.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/stability.h"

namespace taut::test::blanes_moan {
namespace {

using mechanics::Model;

// A cloth without damping, hung by two corners, each point thrown its own way.
Model thrownCloth(double speed) {
    Model model = mechanics::buildCloth({.down = {0, -0.8, 0.6},
                                         .size = {0.4, 0.4},
                                         .cells = {6, 6},
                                         .material = {0.3, 400.0, 200.0, 4.0, 0.0, 0.0, {}}});
    hold(model, "top-left");
    hold(model, "top-right");
    for (std::size_t i = 0; i < model.velocities.size(); ++i) {
        const double s = static_cast<double>(i);
        if (!model.held[i])
            model.velocities[i] = speed * dvec3(std::sin(2.0 * s), std::cos(5.0 * s), std::sin(3.0 * s + 1.0));
    }
    return model;
}

double omegaOf(const Model& model) {
    std::vector<double> inverseMasses;
    for (std::size_t i = 0; i < model.masses.size(); ++i)
        inverseMasses.push_back(model.held[i] ? 0.0 : 1.0 / model.masses[i]);
    return mechanics::boundAnywhere({model.springs, inverseMasses}, {}).omega;
}

// 20000 steps at half of the limit, wild motion at all frequencies: the slope of the energy over the run is the chance
// remainder of its swing. Runge-Kutta 4 at the same cost loses far more.
TEST(BlanesMoanEnergy, DoesNotDriftWhereRungeKuttasDoes) {
    const Model model = thrownCloth(3.0);
    const double h = 1.6 / omegaOf(model);
    const auto energies = [&](const char* method, double step, int stepsPerLook) {
        Network network(model, method, step, {0, -9.81, 0});
        std::vector<double> seen{network.energy()};
        for (int look = 0; look < 40; ++look) {
            network.step(stepsPerLook);
            seen.push_back(network.energy());
        }
        return seen;
    };
    Network start(model, "leapfrog", h, {0, -9.81, 0});
    const double scale = start.kinetic();
    const std::vector<double> ours = energies("blanes-moan", h, 500);
    const auto [least, most] = std::minmax_element(ours.begin(), ours.end());
    EXPECT_LT(*most - *least, 1e-3 * scale);
    double early = 0.0, late = 0.0;
    for (std::size_t i = 1; i <= 20; ++i) early += ours[i] / 20, late += ours[20 + i] / 20;
    EXPECT_LT(std::abs(late - early), 3e-4 * scale);
    const std::vector<double> theirs = energies("rk4", h * 4.0 / 6.0, 750);
    EXPECT_LT(theirs.back() - theirs.front(), -0.03 * scale);
}

// At 3000 evaluations a second of cloth: the error of leap-frog is more than ten times as large, that of Runge-Kutta 4
// with twice as many steps a second not smaller. The reference is Runge-Kutta 4, twelve times finer.
TEST(BlanesMoanError, IsTheSmallestAtEqualCost) {
    const Model model = thrownCloth(0.2);
    constexpr double horizon = 0.2;
    const auto placesAfter = [&](const char* method, int steps) {
        Network network(model, method, horizon / steps, {0, -9.81, 0});
        network.step(steps);
        return network.positions();
    };
    const std::vector<dvec3> ought = placesAfter("rk4", 4000);
    const auto error = [&](const char* method, int steps) {
        double sum = 0.0;
        const std::vector<dvec3> is = placesAfter(method, steps);
        for (std::size_t i = 0; i < is.size(); ++i) sum += glm::dot(is[i] - ought[i], is[i] - ought[i]);
        return std::sqrt(sum / static_cast<double>(is.size()));
    };
    const double ours = error("blanes-moan", 200), leapfrogs = error("leapfrog", 1200), theirs = error("rk4", 300);
    EXPECT_GT(ours, 1e-10);  // above the reference's own
    EXPECT_LT(ours, 0.1 * leapfrogs);
    EXPECT_LT(ours, 0.3 * theirs);
}

}  // namespace
}  // namespace taut::test::blanes_moan
