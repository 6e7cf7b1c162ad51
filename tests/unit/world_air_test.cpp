// The air that a cloth takes along in a wind: inertia without weight.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "support/timelines.h"
#include "taut/bodies/cloth.h"
#include "taut/forces/wind.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

// A level sheet of 0.1 kg/m² with 0.05 kg/m² of air falls; the wind, if there is one, resists nothing.
SceneSpec falling(bool hasWind) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    MaterialSpec& sheet = scene.materials["sheet"];
    sheet.density = 0.1;
    sheet.air = 0.05;
    sheet.drag = 0.0;
    ClothSpec cloth;
    cloth.name = "sheet";
    cloth.material = "sheet";
    cloth.size = {0.4, 0.3};
    cloth.cells = {4, 3};
    cloth.down = {0, 0, 1};
    scene.bodies.add(cloth);
    WindSpec wind;
    wind.name = "still";
    wind.drag = wind.lift = 0.0;
    if (hasWind) scene.forces.add(wind);
    return scene;
}

TEST(Air, GoesAlongInAWindAndWeighsNothing) {
    for (const bool hasWind : {true, false}) {
        World world(falling(hasWind));
        support::run(world, 30);
        const double acceleration = -9.81 * (hasWind ? 0.1 / 0.15 : 1.0);
        const double t = 30 * world.tickSeconds(), mass = (hasWind ? 0.15 : 0.1) * 0.12;
        const Metrics metrics = world.metrics();
        EXPECT_NEAR(metrics.momentum.y, mass * acceleration * t, 1e-12);
        EXPECT_NEAR(metrics.kinetic, 0.5 * mass * acceleration * acceleration * t * t, 1e-12);
        EXPECT_NEAR(metrics.elastic, 0.0, 1e-12);
        EXPECT_NEAR(metrics.kinetic + metrics.gravitational, 0.0, 1e-11);
        EXPECT_NEAR(world.islands().front().mass, 0.012, 1e-15);
    }
}

// A sheet at θ to level goes aside until the force on it is upright. Let its way be δ from the vertical, ψ = θ + δ:
// (C_D - C_L cos ψ) sin δ = C_L sin θ, and ½ρu² cos ψ ((C_D - C_L cos ψ) cos δ + C_L cos θ) is its weight per area.
// Every part of it feels the same pressure, so that it does not turn without `flutter`.
TEST(Air, ASheetThatIsNotLevelGlidesOnAsItDoes) {
    const double theta = 0.25, drag = 1.0, lift = 0.6;
    double low = 0, high = 0.5 * std::numbers::pi - theta;
    for (int i = 0; i < 60; ++i) {
        const double delta = 0.5 * (low + high);
        ((drag - lift * std::cos(theta + delta)) * std::sin(delta) < lift * std::sin(theta) ? low : high) = delta;
    }
    SceneSpec scene = falling(false);
    const double cosine = std::cos(theta + low),
                 upright = cosine * ((drag - lift * cosine) * std::cos(low) + lift * std::cos(theta)),
                 speed = std::sqrt(0.1 * 9.81 / (0.5 * scene.world.airDensity * upright));
    scene.materials["sheet"].rigidity.warp = 10.0;
    auto& cloth = static_cast<ClothSpec&>(*scene.bodies.begin());
    cloth.across = {std::cos(theta), -std::sin(theta), 0};
    cloth.velocity = speed * dvec3(std::sin(low), -std::cos(low), 0);
    WindSpec wind;
    wind.name = "still";
    wind.drag = drag;
    wind.lift = lift;
    scene.forces.add(wind);
    World world(scene);
    support::run(world, 120);
    // [m/s] As stiff as it is the sheet still bends by some 1e-5. A force off by a thousandth would make it 1e-2.
    const dvec3 off = world.metrics().momentum / (0.15 * 0.12) - cloth.velocity;
    EXPECT_LT(glm::length(off), 1e-4);
}

// A stiff sheet without drag and lift is a rigid plate. Newton's and Euler's equations with Munk's moment -m_a u w
// about the width, and the forces 2 m_a θ' u n - m_a θ' w t, by a method of Runge and Kutta. u and w are the velocity
// along the sheet (t) and along its normal (n), θ its slant.
TEST(Air, MakesAStiffSheetSwing) {
    SceneSpec scene = falling(false);
    WindSpec wind;
    wind.name = "still";
    wind.drag = 0.0;
    wind.lift = 1e-12;
    scene.forces.add(wind);
    scene.materials["sheet"].rigidity.warp = 40.0;
    scene.materials["sheet"].flutter = 1.0;
    auto& cloth = static_cast<ClothSpec&>(*scene.bodies.begin());
    cloth.across = {std::cos(0.4), std::sin(0.4), 0};
    World world(scene);
    const auto energy = [&] {
        const Metrics metrics = world.metrics();
        return metrics.kinetic + metrics.elastic + metrics.gravitational;
    };
    const double energyBefore = energy();
    const int ticks = 30;
    support::run(world, ticks);

    const double area = 0.12, mass = 0.15 * area, air = 0.05 * area, weight = 0.1 * area * 9.81;
    double squares = 0;  // Σ share · s² of columns 0.1 m apart, those at the edges half
    for (const double s : {-0.1, 0.0, 0.1}) squares += s * s / 4.0;
    squares += 2 * 0.04 / 8.0;
    using State = std::array<double, 4>;  // vx, vy, θ, θ'
    const auto slope = [&](const State& y) {
        const auto [vx, vy, angle, rate] = y;
        const double u = vx * std::cos(angle) + vy * std::sin(angle), w = vy * std::cos(angle) - vx * std::sin(angle);
        const double alongT = -air * rate * w, alongN = 2 * air * rate * u;
        return State{(alongT * std::cos(angle) - alongN * std::sin(angle)) / mass,
                     (alongT * std::sin(angle) + alongN * std::cos(angle) - weight) / mass, rate,
                     -air * u * w / (mass * squares)};
    };
    State y{0, 0, 0.4, 0};
    const int steps = 3000;
    const double h = ticks * world.tickSeconds() / steps;
    for (int i = 0; i < steps; ++i) {
        const auto ahead = [&](const State& k, double by) {
            State moved = y;
            for (std::size_t j = 0; j < 4; ++j) moved[j] += by * k[j];
            return moved;
        };
        const State a = slope(y), b = slope(ahead(a, h / 2)), c = slope(ahead(b, h / 2)), d = slope(ahead(c, h));
        for (std::size_t j = 0; j < 4; ++j) y[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
    }
    EXPECT_LT(y[2], -0.1);  // it has swung through
    EXPECT_NEAR(world.metrics().momentum.x / mass, y[0], 1e-5);
    EXPECT_NEAR(world.metrics().momentum.y / mass, y[1], 1e-5);
    EXPECT_NEAR(energy(), energyBefore, 1e-6);  // the air's forces do no work
}

}  // namespace
}  // namespace taut::world
