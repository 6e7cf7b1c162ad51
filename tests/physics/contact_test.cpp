// Points against a plane through the world: bounces, slopes, and contact that is much stiffer than what holds it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"
#include "taut/ode/method_table.h"
#include "taut/world/bodies/net.h"

namespace taut::test::contact {
namespace {

constexpr double g = 9.81;

world::SceneSpec onePointOver(double height, double tick, std::string method = "leapfrog") {
    world::SceneSpec scene = exactScene(tick, std::move(method));
    world::NetSpec net;
    net.name = "ball";
    net.drag = 0.0;
    net.thickness = 0.0;
    net.friction = 1.0;
    net.points = {{"only", {0.0, height, 0.0}, 0.5, false, {}}};
    scene.bodies.add(net);
    world::ColliderSpec plane;
    plane.name = "ground";
    plane.shape = "plane";
    plane.position = {0.0, 0.0, 0.0};
    plane.friction = 0.0;
    scene.colliders.push_back(plane);
    return scene;
}

dvec3 point(world::World& world) {
    return positionsOf(world, "net.ball").front();
}

// Heights of the tops between bounces.
std::vector<double> tops(world::World& world, std::size_t count) {
    std::vector<double> found;
    double before = 0.0, now = point(world).y;
    bool touched = false;
    for (int i = 0; i < 200000 && found.size() < count; ++i) {
        EXPECT_FALSE(world.advance());
        const double next = point(world).y;
        touched = touched || next < 1e-3;
        if (touched && now > before && now >= next) {
            found.push_back(now);
            touched = false;
        }
        before = now;
        now = next;
    }
    return found;
}

// Contact is of first order: a bounce may come a step late, which costs up to v h of the fall twice, 2 √(2 g h0) h/h0 =
// 0.2 % of the height a bounce at h = 2e-4 s and h0 = 1 m, more for lower bounces.
TEST(Bounce, ReturnsTheSquareOfTheRestitutionOfItsHeight) {
    for (const ode::MethodInfo& method : ode::methods())
        for (double restitution : {0.9, 0.6}) {
            SCOPED_TRACE(std::string(method.name) + ", restitution " + std::to_string(restitution));
            world::SceneSpec scene = onePointOver(1.0, 2e-4, std::string(method.name));
            scene.colliders[0].restitution = restitution;
            world::World world(scene);
            const std::vector<double> heights = tops(world, 4);
            ASSERT_EQ(heights.size(), 4U);
            for (std::size_t n = 0; n < heights.size(); ++n)
                EXPECT_NEAR(heights[n] / std::pow(restitution, 2.0 * static_cast<double>(n + 1)), 1.0,
                            0.01 * static_cast<double>(n + 1))
                    << "bounce " << n + 1;
        }
}

TEST(Bounce, WithoutRestitutionEndsAtTheGround) {
    for (const ode::MethodInfo& method : ode::methods()) {
        world::World world(onePointOver(0.3, 1e-3, std::string(method.name)));
        EXPECT_FALSE(advance(world, 1000));
        EXPECT_NEAR(point(world).y, 0.0, 1e-9) << method.name;
        // The velocity that the next force will have given it, g h at most: ½ m (g h)² = 2.4e-5 J.
        EXPECT_LE(world.metrics().kinetic, 2.41e-5) << method.name;
    }
}

// A plane turned by α about z: a = g (sin α - μ cos α) down the slope where tan α > μ, rest elsewhere.
TEST(Incline, LetsAPointSlideAtTheCoulombRateOrNotAtAll) {
    for (const ode::MethodInfo& method : ode::methods())
        for (double slope : {0.3, 0.7})  // [rad]
            for (double share : {0.0, 0.5, 0.95, 1.05}) {
                const double mu = share * std::tan(slope);
                SCOPED_TRACE(std::string(method.name) + ", slope " + std::to_string(slope) + ", μ " +
                             std::to_string(mu));
                world::SceneSpec scene = onePointOver(0.0, 1e-3, std::string(method.name));
                scene.colliders[0].normal = {std::sin(slope), std::cos(slope), 0.0};
                scene.colliders[0].friction = mu;
                world::World world(scene);
                EXPECT_FALSE(advance(world, 1000));
                const double t = 1.0, a = g * (std::sin(slope) - mu * std::cos(slope));
                const dvec3 down(std::cos(slope), -std::sin(slope), 0.0), away(std::sin(slope), std::cos(slope), 0.0);
                const double along = glm::dot(point(world), down);
                EXPECT_NEAR(glm::dot(point(world), away), 0.0, 1e-9);  // on the plane
                if (share > 1.0) {
                    EXPECT_LT(std::abs(along), 1e-6);  // sticks: no creep by what gravity adds in a step, 1e-5 m
                } else {
                    // A step of 1e-3 s of one second: first order, a h t = 0.1 % ... 0.4 % of the way.
                    EXPECT_NEAR(along / (0.5 * a * t * t), 1.0, 5e-3);
                }
            }
}

// A stiff net, ω = 2000/s, dropped on the ground at the step that "auto" finds for the springs: contact adds no
// stiffness.
TEST(StiffContact, AddsNoEnergyAtTheLargestStableStep) {
    for (const ode::MethodInfo& one : ode::methods()) {
        const std::string method(one.name);
        if (method == "euler") continue;  // without damping there is no step for it
        SCOPED_TRACE(method);
        world::SceneSpec scene = onePointOver(0.2, 1.0 / 60.0, method);
        scene.solver.dt.reset();
        // They have no limit, but a linear solve for 1/60 s at ω h = 33 leaps over an impact: at ω h = 1 it does not.
        if (std::isinf(one.largestStep({1.0}))) scene.solver.dt = 5e-4;
        world::NetSpec& net = scene.bodies.of<world::NetSpec>()[0];
        net.points = {{"a", {0, 0.2, 0}, 0.01, false, {}},
                      {"b", {0.1, 0.3, 0}, 0.01, false, {}},
                      {"c", {0, 0.3, 0.1}, 0.01, false, {}},
                      {"d", {-0.1, 0.25, -0.1}, 0.01, false, {}}};
        for (auto [a, b] : {std::pair("a", "b"), {"a", "c"}, {"a", "d"}, {"b", "c"}, {"b", "d"}, {"c", "d"}})
            net.springs.push_back({a, b, 1e4, {}, {}, {}});
        scene.colliders[0].restitution = 0.5;
        scene.colliders[0].friction = 0.4;
        world::World world(scene);
        const auto energy = [&] {
            const world::Metrics m = world.metrics();
            return m.kinetic + m.elastic + m.gravitational;
        };
        const double start = energy();
        ASSERT_GT(start, 0.1);
        double most = 0.0;
        for (int i = 0; i < 600; ++i) {
            ASSERT_FALSE(world.advance());
            most = std::max(most, energy());
        }
        // Leap-frog's own swing of the elastic part by z²/4 at z = 1.2 is a third of it, and that is a few per cent of
        // the whole after an impact.
        EXPECT_LT(most, 1.02 * start);
        EXPECT_LT(energy(), 0.9 * start);  // restitution and friction take their share
        for (const dvec3& x : positionsOf(world, "net.ball")) EXPECT_GT(x.y, -1e-9);
    }
}

}  // namespace
}  // namespace taut::test::contact
