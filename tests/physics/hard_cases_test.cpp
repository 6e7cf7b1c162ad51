// Networks at the edge of definition: no length, no room, no freedom, no balance of masses, not a number.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "support/network.h"
#include "support/oscillator.h"
#include "support/scenes.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/forces/anchor.h"
#include "taut/forces/wind.h"
#include "taut/mechanics/builders.h"

namespace taut::test::hard_cases {
namespace {

using mechanics::Model;

bool areNumbers(const std::vector<dvec3>& values) {
    for (const dvec3& x : values)
        if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z)) return false;
    return true;
}

// A mass between two held points, each 1 m away: ω² = 2k/m along the line and 2k (1 - L/l)/m across it.
Model between(double k, double restLength, dvec3 offset) {
    Model model;
    addPoint(model, {-1, 0, 0}, 1.0, true);
    addPoint(model, offset, 0.2);
    addPoint(model, {1, 0, 0}, 1.0, true);
    addSpring(model, 0, 1, k, restLength);
    addSpring(model, 1, 2, k, restLength);
    return model;
}

// The limit of each method for that ω along the line; across it the springs are softer. Methods that let undamped
// motion grow at any step have none: there half of 2/ω grows as well. Implicit Euler holds at any step.
TEST(PretensionedSpring, HasTheSameLimitAsAtRest) {
    constexpr double k = 50.0;
    ode::FastestMode mode;
    mode.omega = std::sqrt(2.0 * k / 0.2);
    for (const ode::MethodInfo& method : ode::methods())
        for (double restLength : {1.0, 0.5, 0.0}) {
            SCOPED_TRACE(std::string(method.name) + ", rest length " + std::to_string(restLength));
            const Model model = between(k, restLength, {1e-6, 2e-6, 0});
            const double limit = method.largestStep(mode);
            const double stable = std::isfinite(limit) ? 0.99 * limit : 100.0 / mode.omega;
            // Growth in Blanes and Moan's method from 3.13 on is slow, and not beyond 3.16.
            const double unstable = method.name == "blanes-moan" ? 6.4 / mode.omega
                                    : limit > 0.0                ? 1.01 * limit
                                                                 : 1.0 / mode.omega;
            if (limit > 0.0) {
                Network calm(model, method.name, stable);
                calm.step(20000);
                // 1/√(1 - 0.99²) = 7 times the start for leap-frog, for each part of it.
                EXPECT_LT(glm::length(calm.position(1)), 1e-4);
            }
            if (std::isfinite(limit)) {
                // At least 1.07 a step, until the mass leaves the range in which the line is straight.
                Network wild(model, method.name, unstable);
                wild.step(500);
                EXPECT_FALSE(glm::length(wild.position(1)) < 0.1);
            }
        }
}

// m = 1, k = 2, h = 1: z² = 2 and the leap-frog visits 1, 0, -1, 0, with no rounding at all.
TEST(ZeroRestLength, IsLinearThroughZero) {
    for (const char* method : {"leapfrog", "velocity-verlet"}) {
        Model model;
        addPoint(model, {0, 0, 0}, 1.0, true);
        addPoint(model, {1, 0, 0}, 1.0);
        addSpring(model, 0, 1, 2.0, 0.0);
        Network network(model, method, 1.0);
        const double ought[] = {1, 0, -1, 0};
        for (int n = 1; n <= 400; ++n) {
            network.step();
            ASSERT_EQ(network.position(1), dvec3(ought[n % 4], 0, 0)) << method << ", step " << n;
        }
    }
}

// Straight through its other end a spring without rest length is the linear oscillator, under every method: the same
// steps on x'' = -ω² x, to rounding.
TEST(ZeroRestLength, IsTheLinearOscillatorInEveryMethod) {
    for (const ode::MethodInfo& method : ode::methods()) {
        Model model;
        addPoint(model, {0, 0, 0}, 1.0, true);
        addPoint(model, {1, 0, 0}, 0.5);
        addSpring(model, 0, 1, 2.0, 0.0);
        Oscillator oscillator({.omega = 2.0});
        Network network(model, method.name, 0.05);
        Integration<double> ought = integrate(oscillator, method.name, 0.05, {1.0, 0.0});
        int signs = 0;
        for (int n = 1; n <= 400; ++n) {
            const double before = network.position(1).x;
            network.step();
            ought.step();
            signs += before * network.position(1).x < 0.0;
            // Rounding of 400 steps, in solves to 1e-13 too. Explicit Euler grows 7 times.
            ASSERT_NEAR(network.position(1).x, ought.state.x[0], 1e-11) << method.name << ", step " << n;
        }
        EXPECT_NEAR(signs, 12, 1) << method.name;  // 20 s at ω = 2: 6.4 turns
    }
}

TEST(ZeroRestLength, WithADashpotComesToRestAtZero) {
    for (const ode::MethodInfo& method : ode::methods()) {
        Model model;
        addPoint(model, {0, 0, 0}, 1.0, true);
        addPoint(model, {1, 0, 0}, 1.0);
        addSpring(model, 0, 1, 100.0, 0.0, 0.02);  // ω = 10, ζ = 0.1
        Network network(model, method.name, 5e-3);
        network.step(8000);  // e^{-40} of the start is left
        EXPECT_LT(glm::length(network.position(1)), 1e-12) << method.name;
    }
}

// Where two points coincide a spring has no direction and gives no force; a push apart gives it one.
TEST(CoincidentPoints, StayFiniteAndPartWhenPushed) {
    for (const ode::MethodInfo& method : ode::methods())
        for (double apart : {0.0, 1e-320, 1e-170, 1e-30, 1e-12}) {
            SCOPED_TRACE(std::string(method.name) + ", apart " + std::to_string(apart));
            Model model;
            addPoint(model, {0, 0, 0}, 0.5);
            addPoint(model, {apart, 0, 0}, 0.5);
            addSpring(model, 0, 1, 20.0, 0.3, 1e-3);
            Network still(model, method.name, 1e-3);
            still.step(1000);
            EXPECT_TRUE(areNumbers(still.positions()));
            if (apart == 0.0) EXPECT_EQ(still.position(0), still.position(1));
            model.velocities[1] = {0, 1, 0};
            Network pushed(model, method.name, 1e-3);
            pushed.step(1000);
            EXPECT_TRUE(areNumbers(pushed.positions()));
            EXPECT_GT(glm::length(pushed.position(1) - pushed.position(0)), 0.05);
            // The momentum of the push, ½ of 1 m/s for each: 0.5 m of the centre in 1 s. Rounding.
            EXPECT_NEAR(0.5 * (pushed.position(0).y + pushed.position(1).y), 0.5, 1e-12);
        }
}

// ω² = k (1/m + 1/M); the distance swings as the oscillator of that ω does under the same method (leap-frog and
// velocity Verlet: cos(n θ)), the centre of mass does not move.
TEST(MassRatioOfAMillion, SwingsAsTheReducedMassDoes) {
    constexpr double k = 30.0, light = 1e-3, heavy = 1e3, swing = 0.05;
    const double omega = std::sqrt(k * (1.0 / light + 1.0 / heavy)), h = 0.2 / omega;
    ode::FastestMode mode;
    mode.omega = omega;
    for (const ode::MethodInfo& method : ode::methods()) {
        const int steps = method.largestStep(mode) > 0.0 ? 20000 : 100;  // explicit Euler grows 7 times in 100
        Model model;
        addPoint(model, {0, 0, 0}, heavy);
        addPoint(model, {1.0 + swing, 0, 0}, light);
        addSpring(model, 0, 1, k, 1.0);
        Network network(model, method.name, h);
        Oscillator oscillator({.omega = omega});
        Integration<double> ought = integrate(oscillator, method.name, h, {swing, 0.0});
        for (int n = 1; n <= steps; ++n) {
            network.step();
            ought.step();
            const double now = network.position(1).x - network.position(0).x - 1.0;
            // 2e4 steps of rounding at 1e-16 of 1 m, of 0.05 m: 1e-10 when they add up.
            ASSERT_NEAR(now / swing, ought.state.x[0] / swing, 1e-9) << method.name << ", step " << n;
            if (method.name == "leapfrog" || method.name == "velocity-verlet")
                ASSERT_NEAR(now / swing, std::cos(2.0 * n * std::asin(omega * h / 2.0)), 1e-9) << n;
        }
        EXPECT_LT(glm::length(network.momentum()), 1e-12) << method.name;
    }
}

std::uint64_t bits(double x) {
    return std::bit_cast<std::uint64_t>(x);
}

void expectSameBits(const dvec3& is, const dvec3& ought) {
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(bits(is[axis]), bits(ought[axis])) << is[axis] << " and " << ought[axis];
}

// A cloth that everything pulls at, starting at negative zeros, in the way of a sphere.
world::AnchorSpec anchor(const char* name, const char* target, const glm::dvec3& at, double damping) {
    world::AnchorSpec spec;
    spec.name = name;
    spec.target = target;
    spec.at = at;
    spec.stiffness = 5.0;
    spec.damping = damping;
    return spec;
}

world::SceneSpec pulledCloth(const char* method, world::Precision precision, const char* held) {
    world::SceneSpec scene;
    scene.solver.integrator = method;
    scene.solver.precision = precision;
    scene.materials["cotton"] = {0.2, 400.0, 200.0, 1.0, 1e-3, 1.0, mechanics::Lumping::weighted, {}};
    world::ClothSpec cloth;
    cloth.name = "sheet";
    cloth.material = "cotton";
    cloth.size = {0.7, 0.5};
    cloth.cells = {7, 5};
    cloth.origin = {-0.0, -0.0, -0.0};
    cloth.hold = {held};
    cloth.velocity = {0.1, -0.2, 0.3};
    cloth.spin = {1.0, 2.0, 3.0};
    cloth.jitter = 1e-3;
    scene.bodies.add(cloth);
    world::WindSpec wind;
    wind.name = "gale";
    wind.velocity = {3.0, -1.0, 5.0};
    wind.gustAmplitude = 2.0;
    scene.forces.add(wind);
    scene.forces.add(anchor("hook", "cloth.sheet@top", {0.3, 1.0, 0.2}, 0.1));
    world::ColliderSpec ball;
    ball.name = "ball";
    ball.position = {0.0, -0.1, 0.0};
    ball.radius = 0.2;
    scene.colliders.push_back(ball);
    return scene;
}

TEST(HeldPoints, DoNotMoveByABitInAnyMethod) {
    for (const ode::MethodInfo& method : ode::methods())
        for (world::Precision precision : {world::Precision::single_, world::Precision::double_}) {
            SCOPED_TRACE(method.name);
            world::SceneSpec scene = pulledCloth(method.name.data(), precision, "left");
            if (method.name == "euler") scene.solver.dt = 1e-5;  // once gravity has tensed the springs
            world::World world(scene);
            const std::vector<dvec3> start = positionsOf(world, "cloth.sheet");
            expectSameBits(start[0], dvec3(0.0));  // a start at -0 is one at +0
            EXPECT_FALSE(advance(world, 60));
            const std::vector<dvec3> end = positionsOf(world, "cloth.sheet");
            for (std::size_t row = 0; row < 6; ++row) expectSameBits(end[8 * row], start[8 * row]);
            EXPECT_GT(glm::length(end[47] - start[47]), 0.01);  // the others do
        }
}

TEST(HeldPoints, MayBeAllOfThem) {
    for (const ode::MethodInfo& method : ode::methods()) {
        SCOPED_TRACE(method.name);
        world::World world(pulledCloth(method.name.data(), world::Precision::double_, "all"));
        const std::vector<dvec3> start = positionsOf(world, "cloth.sheet");
        EXPECT_FALSE(advance(world, 20));
        const std::vector<dvec3> end = positionsOf(world, "cloth.sheet");
        for (std::size_t i = 0; i < end.size(); ++i) expectSameBits(end[i], start[i]);
        EXPECT_EQ(world.metrics().kinetic, 0.0);
    }
}

// 20 links pressed to 80 % of their length between two held points.
TEST(CompressedChain, StaysStraightUntilDisturbedThenBucklesAndStaysFinite) {
    constexpr double k = 200.0, mass = 0.01, tau = 1e-4, drag = 2.0;
    ode::FastestMode mode;
    mode.omega = 2.0 * std::sqrt(k / mass);
    mode.tau = tau;
    mode.drag = mode.largestDrag = drag;
    for (double stir : {0.0, 1e-9}) {
        Model model;
        for (int i = 0; i <= 20; ++i) {
            addPoint(model, {0.04 * i, i % 2 == 1 ? stir : 0.0, 0.0}, mass, i == 0 || i == 20);
            model.dragRates.back() = drag;
        }
        for (int i = 0; i < 20; ++i) addSpring(model, i, i + 1, k, 0.05, tau);
        for (const ode::MethodInfo& method : ode::methods()) {
            SCOPED_TRACE(std::string(method.name) + ", stir " + std::to_string(stir));
            const double h = std::min(1e-3, 0.5 * method.largestStep(mode));
            Network network(model, method.name, h);
            network.step(static_cast<std::int64_t>(20.0 / h));
            ASSERT_TRUE(areNumbers(network.positions()));
            double across = 0.0, length = 0.0;
            for (int i = 0; i < 20; ++i) {
                across = std::max(across, std::abs(network.position(i).y));
                length += glm::length(network.position(i + 1) - network.position(i));
            }
            if (stir == 0.0) {
                EXPECT_EQ(across, 0.0);
                EXPECT_NEAR(length, 0.8, 1e-12);  // rounding
            } else {
                // It has found its length of 1 m again: drag of 2/s for 20 s leaves e^-20 of the motion.
                EXPECT_GT(across, 0.01);
                EXPECT_NEAR(length, 1.0, 1e-3);
            }
        }
    }
}

// The sweep of leap-frog overwrites positions while it still computes forces; velocity Verlet does not. A cloth of many
// blocks shows any that was overwritten too early.
TEST(LeapfrogInPlace, GivesThePositionsOfVelocityVerletOnALargeCloth) {
    Model model = mechanics::buildCloth(
        {.size = {1.5, 1.0}, .cells = {150, 100}, .material = {0.2, 500.0, 250.0, 5.0, 1e-5, 0.3, {}}});
    hold(model, "top");
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        const double s = static_cast<double>(i);
        model.positions[i] += 1e-4 * dvec3(std::sin(s), std::sin(1.7 * s), std::sin(2.3 * s));
    }
    Network leapfrog(model, "leapfrog", 1e-4, {0, -9.81, 0}), verlet(model, "velocity-verlet", 1e-4, {0, -9.81, 0});
    leapfrog.step(100);
    verlet.step(100);
    for (int i = 0; i < model.pointCount(); ++i)
        // 100 steps of rounding at 1 m, enlarged by springs of ω h = 1: 1e-13; a wrong neighbour would show as 1e-5.
        ASSERT_LT(glm::length(leapfrog.position(i) - verlet.position(i)), 1e-11) << "point " << i;
}

TEST(NotANumber, InAnAnchorStopsTheRunAndNamesThePointInEveryMethod) {
    for (const ode::MethodInfo& method : ode::methods())
        for (world::Precision precision : {world::Precision::single_, world::Precision::double_}) {
            SCOPED_TRACE(method.name);
            world::SceneSpec scene = pulledCloth(method.name.data(), precision, "left");
            scene.forces = {};
            scene.solver.dashpots = world::Dashpots::extrapolated;  // split off they pass it on
            scene.forces.add(anchor("hook", "cloth.sheet@#13", {std::numeric_limits<double>::quiet_NaN(), 0, 0}, 0.0));
            world::World world(scene);
            const auto divergence = world.advance();
            ASSERT_TRUE(divergence);
            EXPECT_EQ(divergence->tick, 0);
            EXPECT_EQ(divergence->body, "cloth.sheet");
            // Methods that ask for forces once a step have it in that point alone. The others pass it on within the
            // step, and name the first that has it.
            const bool isAlone = method.evaluations == 1 && method.name != "velocity-verlet";
            if (isAlone) EXPECT_EQ(divergence->point, 13);
            const std::string point = "point " + std::to_string(divergence->point);
            EXPECT_NE(divergence->message.find(point + " has a velocity that is not a number"), std::string::npos)
                << divergence->message;
        }
}

TEST(NotANumber, ThatAppearsInMidRunStopsItInThatTickAndKeepsTheRest) {
    for (const ode::MethodInfo& method : ode::methods()) {
        SCOPED_TRACE(method.name);
        world::SceneSpec scene = pulledCloth(method.name.data(), world::Precision::single_, "left");
        if (method.name == "euler") scene.solver.dt = 1e-5;  // as above
        world::World world(scene);
        world.addSystem([](world::World& w, double, double) {
            if (w.tick() != 10) return;
            world::NetSpec net;
            net.name = "bad";
            net.points = {{"a", {0, 5, 0}, 1.0, false, {}},
                          {"b", {0, std::numeric_limits<double>::infinity(), 0}, 1.0, true, {}}};
            net.springs = {{"a", "b", 10.0, 1.0, {}, {}}};
            w.spawn(net);
        });
        EXPECT_FALSE(advance(world, 10));
        const auto divergence = world.advance();
        ASSERT_TRUE(divergence);
        EXPECT_EQ(divergence->tick, 10);
        EXPECT_EQ(divergence->body, "net.bad");
        EXPECT_EQ(divergence->point, 0);
        EXPECT_TRUE(areNumbers(positionsOf(world, "cloth.sheet")));
    }
}

// Within one tick from sound numbers to none: an anchor that overflows single precision.
TEST(NotANumber, ByOverflowKeepsTheLastGoodState) {
    for (const ode::MethodInfo& method : ode::methods()) {
        if (std::isinf(method.largestStep({1.0}))) continue;  // no step is too long for it: the point stays where it is
        SCOPED_TRACE(method.name);
        world::SceneSpec scene = exactScene(0.01, std::string(method.name));
        scene.solver.precision = world::Precision::single_;
        world::NetSpec net;
        net.name = "two";
        net.points = {{"a", {0, 0, 0}, 1.0, true, {}}, {"b", {0, 1, 0}, 1.0, false, {}}};
        net.springs = {{"a", "b", 3e38, 1.0, {}, {}}};
        scene.bodies.add(net);
        world::World world(scene);
        EXPECT_FALSE(world.warnings().empty());
        const auto divergence = advance(world, 10);
        ASSERT_TRUE(divergence);
        EXPECT_EQ(divergence->body, "net.two");
        EXPECT_EQ(divergence->point, 1);
        EXPECT_NE(divergence->spring.find("0–1"), std::string::npos) << divergence->spring;
        EXPECT_TRUE(areNumbers(positionsOf(world, "net.two")));
    }
}

}  // namespace
}  // namespace taut::test::hard_cases
