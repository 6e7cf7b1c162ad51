// Points against a plane through the world: bounces, slopes, and contact that is much stiffer than the springs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scenes.h"
#include "taut/bodies/net.h"
#include "taut/ode/method_table.h"

namespace taut::test::colliders {
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
                    EXPECT_LT(std::abs(along), 1e-6);  // sticks: no creep by the fall of a step, 1e-5 m
                } else {
                    // A step of 1e-3 s of one second: first order, a h t = 0.1 % ... 0.4 % of the way.
                    EXPECT_NEAR(along / (0.5 * a * t * t), 1.0, 5e-3);
                }
            }
}

// A velocity at the time of a contact must not show half a step of gravity.
TEST(Rest, IsSpeedZeroUnderAnyGravity) {
    for (const ode::MethodInfo& method : ode::methods()) {
        if (method.name == "euler") continue;  // the energy that each fall adds keeps it bouncing
        for (double gravity : {9.81, 25.0, 200.0}) {
            world::SceneSpec scene = onePointOver(0.005, 1.0 / 60.0, std::string(method.name));
            scene.world.gravity = dvec3(0.0, -gravity, 0.0);
            scene.colliders[0].restitution = 0.3;
            world::World world(scene);
            EXPECT_FALSE(advance(world, 120));
            EXPECT_EQ(glm::length(world.points("net.ball").v[0]), 0.0) << method.name << ", " << gravity << " m/s²";
        }
    }
}

// Forces that do not change: leap-frog has v = a t exactly, friction included, a = g (sin α - μ cos α).
TEST(Incline, SlidesAtTheSpeedOfTheTime) {
    const double slope = 0.7, mu = 0.5 * std::tan(slope), a = g * (std::sin(slope) - mu * std::cos(slope));
    world::SceneSpec scene = onePointOver(0.0, 1.0 / 60.0);
    scene.colliders[0].normal = {std::sin(slope), std::cos(slope), 0.0};
    scene.colliders[0].friction = mu;
    world::World world(scene);
    for (int i = 1; i <= 60; ++i) {
        ASSERT_FALSE(world.advance());
        EXPECT_NEAR(glm::length(world.points("net.ball").v[0]), a * i / 60.0, 1e-11) << i;
    }
}

// A tetrahedron thrown at the ground, ω = 260/s, spinning.
world::SceneSpec thrownNet(const std::string& method, double restitution, double height = 0.5) {
    world::SceneSpec scene = onePointOver(height, 1.0 / 60.0, method);
    scene.solver.dt.reset();
    world::NetSpec& net = scene.bodies.of<world::NetSpec>()[0];
    net.velocity = {3.0, -4.0, 1.0};
    net.spin = {3.0, 1.0, 5.0};
    net.points = {{"a", {0.0, height, 0.0}, 0.2, false, {}},
                  {"b", {0.4, height + 0.1, 0.1}, 0.1, false, {}},
                  {"c", {0.1, height + 0.4, 0.3}, 0.3, false, {}},
                  {"d", {0.2, height + 0.2, -0.3}, 0.2, false, {}}};
    for (auto [a, b] : {std::pair("a", "b"), {"a", "c"}, {"a", "d"}, {"b", "c"}, {"b", "d"}, {"c", "d"}})
        net.springs.push_back({a, b, 2000.0, {}, {}, {}});
    scene.colliders[0].restitution = restitution;
    return scene;
}

// A kilogram on three light feet, ω = 900/s, in steps of 1/60 s: friction has to go by the weight that the feet bear.
TEST(StiffContact, SlowsWhatStandsOnItByTheFrictionOfItsWholeWeight) {
    world::SceneSpec scene = onePointOver(0.0, 1.0 / 60.0, "implicit-euler");
    const double mu = 0.3, v = 2.0;
    scene.colliders[0].friction = mu;
    world::NetSpec& net = scene.bodies.of<world::NetSpec>()[0];
    net.velocity = {v, 0.0, 0.0};
    net.points = {{"a", {0.0, 0.0, 0.0}, 0.05, false, {}},
                  {"b", {0.4, 0.0, 0.0}, 0.05, false, {}},
                  {"c", {0.2, 0.0, 0.35}, 0.05, false, {}},
                  {"top", {0.2, 0.3, 0.12}, 1.0, false, {}}};
    for (auto [a, b] : {std::pair("a", "b"), {"a", "c"}, {"a", "top"}, {"b", "c"}, {"b", "top"}, {"c", "top"}})
        net.springs.push_back({a, b, 2e4, {}, {}, {}});
    world::World world(scene);
    EXPECT_FALSE(advance(world, 24));
    const double t = 24.0 / 60.0;
    EXPECT_NEAR(world.metrics().momentum.x / 1.15, v - mu * g * t, 2e-3);  // it rocks a little on its feet
    EXPECT_FALSE(advance(world, 36));
    EXPECT_NEAR(world.metrics().momentum.x / 1.15, 0.0, 2e-3);  // and stands
}

bool saysThatContactAdded(const world::World& world) {
    const std::vector<std::string> all = printed(world.warnings());
    return std::any_of(all.begin(), all.end(), [](const std::string& warning) {
        return warning.find("contact has added") != std::string::npos;
    });
}

TEST(StiffContact, AddsLittleEnergyAtAutoAndSaysWhatItAddsByHand) {
    for (const ode::MethodInfo& method : ode::methods()) {
        if (method.name == "euler") continue;  // it adds energy by itself
        for (double restitution : {0.0, 1.0}) {
            SCOPED_TRACE(std::string(method.name) + ", restitution " + std::to_string(restitution));
            world::World world(thrownNet(std::string(method.name), restitution));
            EXPECT_FALSE(advance(world, 480));  // some thirty impacts where it bounces
            EXPECT_TRUE(world.hasTouched());
            EXPECT_FALSE(saysThatContactAdded(world));
        }
    }
    world::SceneSpec byHand = thrownNet("leapfrog", 1.0);
    byHand.solver.dt = 1.0 / 240.0;
    world::World world(byHand);
    EXPECT_FALSE(advance(world, 120));
    EXPECT_TRUE(saysThatContactAdded(world));
}

// Of methods whose steps follow the state, and of others.
TEST(StiffContact, GoesOnInTheStepsThatItHasShortened) {
    for (const char* method : {"leapfrog", "heun"}) {
        SCOPED_TRACE(method);
        world::World whole(thrownNet(method, 1.0));
        const int before = whole.islands().front().substeps;
        int most = before;
        for (int i = 0; i < 5; ++i) {
            const std::vector<std::byte> saved = whole.save();
            for (int tick = 0; tick < 31; ++tick) {
                ASSERT_FALSE(whole.advance());
                most = std::max(most, whole.islands().front().substeps);
            }
            world::World resumed(thrownNet(method, 1.0));
            resumed.restore(saved);
            EXPECT_FALSE(advance(resumed, 31));
            EXPECT_EQ(resumed.stateHash(), whole.stateHash()) << "after " << 31 * i << " ticks";
        }
        EXPECT_GT(most, before);
    }
}

// A ball that creeps up to a dumb-bell at rest, pushes it away and then strikes it a hundred times as fast, at 5 m/s:
// its momentum then is measured against that, not against the creeping, which takes 1024 times as many steps.
TEST(StiffContact, ShortensStepsByWhatThereIsNowNotByWhatThereWasAtFirst) {
    world::SceneSpec scene = onePointOver(0.0, 1.0 / 60.0);
    scene.solver.dt.reset();
    scene.world.gravity = dvec3(0.0);
    world::NetSpec& net = scene.bodies.of<world::NetSpec>()[0];
    net.points = {{"a", {0, 0, 0}, 0.1, false, {}}, {"b", {0, 0.3, 0}, 0.1, false, {}}};
    net.springs.push_back({"a", "b", 1000.0, {}, {}, {}});
    world::ColliderSpec& ball = scene.colliders[0];
    ball.shape = "sphere";
    ball.radius = 0.1;
    ball.restitution = 1.0;
    ball.keys = {{0.0, dvec3(0.0, -0.12, 0.0), dvec3(0.0), world::Ease::linear},
                 {1.0, dvec3(0.0, -0.07, 0.0), dvec3(0.0), world::Ease::linear},
                 {1.2, dvec3(0.0, 0.93, 0.0), dvec3(0.0), world::Ease::linear}};
    world::World world(scene);
    const int quiet = world.islands().front().substeps;
    EXPECT_FALSE(advance(world, 60));
    EXPECT_TRUE(world.hasTouched());
    int most = quiet;
    for (int i = 0; i < 30; ++i) {
        ASSERT_FALSE(world.advance());
        most = std::max(most, world.islands().front().substeps);
    }
    EXPECT_GT(world.metrics().kinetic, 0.5 * 0.1 * 5.0 * 5.0);
    EXPECT_GT(most, quiet);
    EXPECT_LE(most, 64 * quiet);
    EXPECT_FALSE(saysThatContactAdded(world));
}

// Implicit Euler itself only takes energy: a rise is the contact's. On a smooth ground the net slides and spins on.
TEST(StiffContact, NeverRaisesTheEnergyOfImplicitSteps) {
    for (double restitution : {0.0, 1.0}) {
        world::World world(thrownNet("implicit-euler", restitution));
        double least = world.metrics().energy(), risen = 0.0;
        const double start = least;
        for (int i = 0; i < 300; ++i) {
            ASSERT_FALSE(world.advance());
            const double now = world.metrics().energy();
            risen += std::max(0.0, now - least);
            least = now;
        }
        EXPECT_LT(risen, 0.02 * start) << restitution;
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
}  // namespace taut::test::colliders
