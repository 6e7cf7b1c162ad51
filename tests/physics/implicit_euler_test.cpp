// Implicit Euler: its damping, its largest step, its solver against a dense one, and its report when the solver
// does not converge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/network.h"
#include "support/oscillator.h"
#include "support/scenes.h"
#include "taut/bodies/cloth.h"
#include "taut/core/trig.h"

namespace taut::test::implicit_euler {
namespace {

using mechanics::Model;

// x_n = Re (1 + i z)^-n: it falls by 1/√(1 + z²) a step, which is ζ_num ≈ z/2, and turns by atan z, which is z²/3 slow.
TEST(ImplicitEulerOscillator, DampsByHalfOfZAndSwingsSlowly) {
    constexpr double omega = 3.0;
    for (double z : {0.01, 0.3, 2.0, 50.0}) {
        SCOPED_TRACE("z = " + std::to_string(z));
        Oscillator oscillator({omega});
        // The start that has x = 1 on the exact spiral: v from x_-1 by x_0 = x_-1 + h v_0.
        const double before = 1.0;
        Integration<double> run = integrate(oscillator, "implicit-euler", z / omega, {1.0, 0.0});
        EXPECT_EQ(before, run.state.x[0]);
        for (int n = 1; n <= 200; ++n) {
            run.step();
            // From (x, v/ω) = (1, 0) the pair turns by -atan z and shrinks.
            const double size = std::pow(1.0 + z * z, -0.5 * n), angle = n * std::atan(z);
            ASSERT_NEAR(run.state.x[0], size * std::cos(angle), 1e-12) << n;  // rounding of 200 steps
            ASSERT_NEAR(run.state.v[0], -omega * size * std::sin(angle), 1e-11) << n;
        }
    }
    constexpr double z = 0.01;
    EXPECT_NEAR(0.5 * std::log(1.0 + z * z) / std::atan(z), z / 2.0, 1e-6);  // ζ_num, to its next term z³
    EXPECT_NEAR(1.0 - std::atan(z) / z, z * z / 3.0, 1e-8);
}

// A stiff ring that turns freely slows as ω0/√(1 + 2 h ω0² t): its tension turns with it, h ahead of the points. So
// does the solution of Newton's method. A single step finds the springs stretched by the (h ω0)²/2 that the points have
// gone along their tangents, takes that for tension, and is slower by as much as the springs are stiffer.
TEST(ImplicitEulerRing, SlowsAsTheTheorySaysAndMoreInASingleNewtonStep) {
    constexpr int n = 12;
    constexpr double omega = 5.0, h = 2e-3, t = 2.0;
    const auto slowed = [&](double stiffness, int newtonSteps) {
        Model model;
        for (int i = 0; i < n; ++i) {
            const double angle = 2.0 * core::pi * i / n;
            addPoint(model, {std::cos(angle), std::sin(angle), 0.0}, 0.1);
            model.velocities.back() = omega * dvec3(-std::sin(angle), std::cos(angle), 0.0);
        }
        for (int i = 0; i < n; ++i) addSpring(model, i, (i + 1) % n, stiffness, 2.0 * std::sin(core::pi / n));
        Network network(model, "implicit-euler", h, dvec3(0.0), {newtonSteps, 1e-10, 10000});
        const double start = network.angularMomentum().z;
        network.step(static_cast<int>(t / h));
        EXPECT_EQ(network.run().method().work().unconverged, 0);
        return network.angularMomentum().z / start;
    };
    // 2 h ω0² t = 0.2; the formula is the limit of small h ω0 = 0.01, and the ring widens by m ω² r/(k l) = 5e-4.
    const double ought = 1.0 / std::sqrt(1.0 + 2.0 * h * omega * omega * t);
    EXPECT_NEAR(slowed(1e4, 30), ought, 3e-3);
    EXPECT_NEAR(slowed(1e6, 30), ought, 3e-3);
    EXPECT_LT(slowed(1e6, 1), 0.8 * ought);
}

// Twenty links released sideways, one second a step: it hangs within some steps, straight and as long as its weight
// pulls.
TEST(ImplicitEulerChain, HangsAfterAFewStepsOfASecond) {
    Model model;
    addPoint(model, {0, 0, 0}, 1.0, true);
    for (int i = 1; i <= 20; ++i) {
        addPoint(model, {0.05 * i, 0, 0}, 0.01);
        model.dragRates.back() = 0.5;
        addSpring(model, i - 1, i, 400.0, 0.05, 1e-3);
    }
    for (double h : {1.0, 100.0}) {
        Network network(model, "implicit-euler", h, {0, -9.81, 0});
        network.step(400);
        ASSERT_TRUE(network.isBounded(10.0)) << h;
        double y = 0.0;
        for (int i = 1; i <= 20; ++i) {
            y -= 0.05 + 9.81 * 0.01 * (21 - i) / 400.0;        // each link carries the links below
            EXPECT_NEAR(network.position(i).y, y, 1e-6) << h;  // the solver, and the rest of the swing
            EXPECT_NEAR(network.position(i).x, 0.0, 1e-6) << h;
        }
    }
}

// A net with everything a spring can be: tense, slack, damped; one point held, drag.
Model smallNet() {
    Model model;
    const dvec3 places[] = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 1.1, 0}, {0.1, 0.3, 0.9}, {1, 1, 1}, {0.5, -0.6, 0.4}};
    for (int i = 0; i < 6; ++i) {
        addPoint(model, places[i], 0.1 + 0.07 * i, i == 3);
        if (i != 3) model.velocities.back() = {0.3 + 0.4 * places[i].z, 1.0 - 0.2 * i, -2.0 * places[i].x};
        model.dragRates.back() = 0.3 * i;
    }
    for (int a = 0; a < 6; ++a)
        for (int b = a + 1; b < 6; ++b)
            addSpring(model, a, b, 20.0 + 5.0 * a, (b % 2 == 0 ? 0.7 : 1.3) * glm::length(places[b] - places[a]),
                      a % 2 == 0 ? 0.02 : 0.0);
    return model;
}

using Dense = std::vector<std::vector<double>>;

// Gauss with pivots.
std::vector<double> solved(Dense a, std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t best = c;
        for (std::size_t r = c + 1; r < n; ++r)
            if (std::abs(a[r][c]) > std::abs(a[best][c])) best = r;
        std::swap(a[c], a[best]);
        std::swap(b[c], b[best]);
        for (std::size_t r = c + 1; r < n; ++r) {
            const double factor = a[r][c] / a[c][c];
            for (std::size_t k = c; k < n; ++k) a[r][k] -= factor * a[c][k];
            b[r] -= factor * b[c];
        }
    }
    for (std::size_t c = n; c-- > 0;) {
        for (std::size_t k = c + 1; k < n; ++k) b[c] -= a[c][k] * b[k];
        b[c] /= a[c][c];
    }
    return b;
}

// Δv of one step from the formula of Baraff and Witkin with whole matrices.
std::vector<double> denseStep(const Model& model, double h, dvec3 gravity) {
    const std::size_t n = 3 * model.masses.size();
    Dense k(n, std::vector<double>(n, 0.0)), c = k;
    std::vector<double> f(n, 0.0);
    for (const mechanics::Spring& s : model.springs) {
        const auto a = static_cast<std::size_t>(s.a), b = static_cast<std::size_t>(s.b);
        const dvec3 d = model.positions[b] - model.positions[a], u = model.velocities[b] - model.velocities[a];
        const double l = glm::length(d);
        const dvec3 unit = d / l;
        const dvec3 force = (s.stiffness * (l - s.restLength) + s.stiffness * s.dampingTime * glm::dot(u, unit)) * unit;
        for (int i = 0; i < 3; ++i) {
            const auto ai = 3 * a + static_cast<std::size_t>(i), bi = 3 * b + static_cast<std::size_t>(i);
            f[ai] += force[i];
            f[bi] -= force[i];
            for (int j = 0; j < 3; ++j) {
                const auto aj = 3 * a + static_cast<std::size_t>(j), bj = 3 * b + static_cast<std::size_t>(j);
                const double across = (i == j ? 1.0 : 0.0) - unit[i] * unit[j];
                const double stiff = s.stiffness * (unit[i] * unit[j] + std::max(0.0, 1.0 - s.restLength / l) * across);
                const double damp = s.stiffness * s.dampingTime * unit[i] * unit[j];
                k[ai][aj] += stiff, k[bi][bj] += stiff, k[ai][bj] -= stiff, k[bi][aj] -= stiff;
                c[ai][aj] += damp, c[bi][bj] += damp, c[ai][bj] -= damp, c[bi][aj] -= damp;
            }
        }
    }
    Dense matrix(n, std::vector<double>(n, 0.0));
    std::vector<double> right(n, 0.0);
    for (std::size_t row = 0; row < n; ++row) {
        const std::size_t p = row / 3;
        const int axis = static_cast<int>(row % 3);
        if (model.held[p]) {
            matrix[row][row] = 1.0;
            continue;
        }
        const double m = model.masses[p], gamma = m * model.dragRates[p];
        right[row] = h * (f[row] + m * gravity[axis] - gamma * model.velocities[p][axis]);
        for (std::size_t col = 0; col < n; ++col) {
            right[row] -= h * h * k[row][col] * model.velocities[col / 3][static_cast<int>(col % 3)];
            if (!model.held[col / 3]) matrix[row][col] = h * c[row][col] + h * h * k[row][col];
        }
        matrix[row][row] += m + h * gamma;
    }
    return solved(matrix, right);
}

TEST(ImplicitEulerSolver, GivesTheStepOfWholeMatrices) {
    const Model model = smallNet();
    const dvec3 gravity(0, -9.81, 0);
    for (double h : {1e-3, 0.1, 10.0}) {
        const std::vector<double> ought = denseStep(model, h, gravity);
        double scale = 0.0;
        for (double x : ought) scale = std::max(scale, std::abs(x));
        Network network(model, "implicit-euler", h, gravity);
        network.step();
        const std::vector<dvec3> v = network.velocities();
        for (std::size_t i = 0; i < v.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                // The solver stops at 1e-13 of the right-hand side; times the condition of the matrix, 1e2 or so.
                EXPECT_NEAR((v[i] - model.velocities[i])[axis], ought[3 * i + static_cast<std::size_t>(axis)],
                            1e-10 * scale)
                    << h << ", point " << i;
    }
}

// Full Newton solves the equation itself: v' = v + h a(x + h v', v'), and x' = x + h v'.
TEST(ImplicitEulerNewton, SolvesTheNonlinearEquations) {
    const Model model = smallNet();
    const dvec3 gravity(0, -9.81, 0);
    constexpr double h = 0.05;
    double residual[2];
    for (int full = 0; full < 2; ++full) {
        Network network(model, "implicit-euler", h, gravity, {full == 1 ? 60 : 1, 1e-11, 10000});
        network.step();
        const std::vector<dvec3> v = network.velocities();
        // The forces at the end of the step, by a model that is there, from one tiny step of explicit Euler.
        Model there = model;
        there.positions = network.positions();
        there.velocities = v;
        constexpr double tiny = 1e-7;
        Network probe(there, "euler", tiny, gravity);
        probe.step();
        const std::vector<dvec3> moved = probe.velocities();
        residual[full] = 0.0;
        for (std::size_t i = 0; i < v.size(); ++i)
            residual[full] =
                std::max(residual[full], glm::length(v[i] - model.velocities[i] - h * (moved[i] - v[i]) / tiny));
        if (full == 1) {
            EXPECT_EQ(network.run().method().work().unconverged, 0);
            EXPECT_GT(network.run().method().work().evaluations, 2);
        }
    }
    EXPECT_LT(residual[1], 1e-6);  // the difference quotient: rounding of 1e-16/1e-7, times h and accelerations of 100
    EXPECT_GT(residual[0], 1e-3);  // one step does not
}

// A hanging cloth in single and double, one step a tick.
world::SceneSpec hangingCloth(world::Precision precision) {
    world::SceneSpec scene;
    scene.solver.integrator = "implicit-euler";
    scene.solver.precision = precision;
    scene.materials["linen"] = {0.2, 2000.0, 1000.0, 2.0, 1e-3, 0.3, mechanics::Lumping::weighted, {}};
    world::ClothSpec cloth;
    cloth.name = "sheet";
    cloth.material = "linen";
    cloth.cells = {12, 12};
    cloth.down = {0, 0, 1};
    cloth.hold = {"top-left", "top-right"};
    scene.bodies.add(cloth);
    return scene;
}

TEST(ImplicitEulerWorld, TakesOneStepATickAndReportsItsWork) {
    for (world::Precision precision : {world::Precision::single_, world::Precision::double_}) {
        world::World world(hangingCloth(precision));
        EXPECT_EQ(world.islands().front().substeps, 1);
        EXPECT_TRUE(std::isinf(world.islands().front().stepLimit));
        EXPECT_FALSE(advance(world, 60));
        EXPECT_EQ(world.work().evaluations, 60);
        EXPECT_GT(world.work().iterations, 60 * 5);
        EXPECT_EQ(world.work().unconverged, 0);
        EXPECT_EQ(world.metrics().work.iterations, world.work().iterations);
        EXPECT_TRUE(world.warnings().empty());
        EXPECT_LT(world.metrics().maxStrain, 0.1);  // 2 N over 2000 N/m, more at the corners
    }
}

TEST(ImplicitEulerWorld, WarnsWhenSolvesDoNotConverge) {
    for (world::Precision precision : {world::Precision::single_, world::Precision::double_}) {
        world::SceneSpec scene = hangingCloth(precision);
        scene.solver.cgIterations = 3;
        world::World world(scene);
        EXPECT_FALSE(advance(world, 10));
        EXPECT_GT(world.work().unconverged, 0);
        EXPECT_LE(world.work().unconverged, 10);
        ASSERT_EQ(world.warnings().size(), 1U);
        EXPECT_NE(world.warnings()[0].text.find("cloth.sheet: " + std::to_string(world.work().unconverged) + " solves"),
                  std::string::npos)
            << world.warnings()[0].text;
        EXPECT_NE(world.warnings()[0].text.find("cg_iterations = 3"), std::string::npos) << world.warnings()[0].text;
    }
}

// Newton's method reaches the same state from step to step as one linear solve does for small steps.
TEST(ImplicitEulerWorld, TakesNewtonStepsWhenAsked) {
    world::SceneSpec scene = hangingCloth(world::Precision::double_);
    scene.solver.newtonSteps = 30;
    world::World world(scene);
    EXPECT_FALSE(advance(world, 20));
    EXPECT_GT(world.work().evaluations, 40);
    EXPECT_EQ(world.work().unconverged, 0);
}

}  // namespace
}  // namespace taut::test::implicit_euler
