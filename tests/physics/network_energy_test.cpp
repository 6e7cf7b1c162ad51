// Energy of whole networks: kept without damping, lost with it, and counted right by the world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/network.h"
#include "support/scenes.h"
#include "taut/bodies/net.h"

namespace taut::test::network_energy {
namespace {

using mechanics::Model;

constexpr double g = 9.81;

// Four elastic links swinging from a point, from a start far out.
Model swingingChain(double tau, double drag) {
    Model model;
    addPoint(model, {0, 0, 0}, 1.0, true);
    for (int i = 1; i <= 4; ++i) {
        addPoint(model, {0.15 * i, 0.05 * i, 0.02 * i * i}, 0.1);
        model.dragRates.back() = drag;
        addSpring(model, i - 1, i, 200.0, 0.15, tau);
    }
    return model;
}

// ω = 90/s at most, z = 0.09 at h = 1 ms: the energy swings by about z²/4 of the energy of the springs, a few 1e-3 J of
// 1 J.
TEST(SwingingChain, HasNoTrendInItsEnergyOverAHundredThousandSteps) {
    for (const char* method : {"leapfrog", "velocity-verlet"}) {
        SCOPED_TRACE(method);
        const Model model = swingingChain(0.0, 0.0);
        Network network(model, method, 1e-3, {0, -g, 0});
        const double first = network.energy();
        double scale = 0.0;  // the energy that is to be had: from the start to hanging straight
        for (int i = 1; i <= 4; ++i) scale += 0.1 * g * (0.15 * i + 0.05 * i);
        constexpr int looks = 2000;
        double low = first, high = first, slope = 0.0, weight = 0.0;
        for (int i = 0; i < looks; ++i) {
            network.step(50);
            const double energy = network.energy(), s = (i + 0.5) / looks - 0.5;
            low = std::min(low, energy);
            high = std::max(high, energy);
            slope += s * energy;
            weight += s * s;
        }
        EXPECT_LT(high - low, 0.01 * scale);
        EXPECT_GT(high - low, 1e-6 * scale);  // it does swing
        // 2000 looks at a noise of 1e-3 leave 1e-3/√2000 · √12 = 8e-5 of a slope by chance.
        EXPECT_LT(std::abs(slope / weight), 4e-4 * scale);
    }
}

TEST(SwingingChain, LosesEnergyToDashpotsAndDragUntilItHangs) {
    for (auto [tau, drag] : {std::pair(5e-3, 0.0), {0.0, 1.0}, {2e-3, 0.5}})
        for (const ode::MethodInfo& method : ode::methods()) {
            SCOPED_TRACE(std::string(method.name) + ", τ = " + std::to_string(tau) + ", drag " + std::to_string(drag));
            Network network(swingingChain(tau, drag), method.name, method.name == "euler" ? 1e-5 : 1e-3, {0, -g, 0});
            double before = network.energy();
            const double start = before;
            for (int i = 0; i < 10; ++i) {
                network.step(method.name == "euler" ? 20000 : 200);
                // Falls from look to look, 0.2 s apart, but for the swing of leap-frog's own energy, 1e-3 of it.
                EXPECT_LT(network.energy(), before + 2e-3);
                before = network.energy();
            }
            EXPECT_LT(before, start - 0.1);
        }
}

// The world's energy and momentum against the numbers of a net written down here.
TEST(WorldMetrics, AreTheEnergiesAndMomentaOfTheNet) {
    world::SceneSpec scene = exactScene(1e-3);
    world::NetSpec net;
    net.name = "three";
    net.drag = 0.0;
    net.points = {
        {"a", {0, 1, 0}, 0.5, false, {}}, {"b", {1, 1, 0}, 0.25, false, {}}, {"c", {0, 3, 1}, 2.0, false, {}}};
    net.springs = {{"a", "b", 40.0, 0.8, {}, {}}, {"b", "c", 10.0, {}, {}, {}}};
    net.velocity = {1.0, -2.0, 0.5};
    scene.bodies.add(net);
    world::World world(scene);
    const world::Metrics start = world.metrics();
    const dvec3 v(1.0, -2.0, 0.5), weighted(0.25, 0.5 + 0.25 + 6.0, 2.0);  // Σ m x
    // Rounding, also of half a step back and forth.
    EXPECT_NEAR(start.kinetic, 0.5 * 2.75 * 5.25, 1e-12);
    EXPECT_NEAR(start.elastic, 0.5 * 40.0 * 0.04, 1e-12);
    EXPECT_NEAR(start.gravitational, g * weighted.y, 1e-12);
    EXPECT_NEAR(start.maxStrain, 0.25, 1e-12);
    EXPECT_LT(glm::length(start.momentum - 2.75 * v), 1e-12);
    EXPECT_LT(glm::length(start.angularMomentum - glm::cross(weighted, v)), 1e-12);

    EXPECT_FALSE(advance(world, 1000));
    const world::Metrics end = world.metrics();
    EXPECT_NEAR(end.time, 1.0, 1e-12);
    // Free flight for a second under gravity: momentum to rounding, energy but for z²/4 of 0.8 J with z = 0.02.
    EXPECT_LT(glm::length(end.momentum - 2.75 * (v + dvec3(0, -g, 0))), 1e-11);
    EXPECT_NEAR(end.kinetic + end.elastic + end.gravitational, start.kinetic + start.elastic + start.gravitational,
                1e-4);
    const dvec3 turned = glm::cross(weighted, v) +
                         glm::cross(weighted + 0.5 * 2.75 * v, dvec3(0, -g, 0));  // the torque ∫ (Σ m x) × g dt
    EXPECT_LT(glm::length(end.angularMomentum - turned), 1e-10);
}

}  // namespace
}  // namespace taut::test::network_energy
