// Figures against bodies: boxes that an animation moves.
#include <gtest/gtest.h>

#include <cmath>

#include "support/figures.h"
#include "support/timelines.h"
#include "taut/core/trig.h"
#include "taut/figure/figure.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

using figure::Path;
using support::animate;
using support::boxes;
using support::colliderOf;
using support::run;

constexpr double apart = 0.01;  // [m]

// Level, of 0.4 m, about the axis y; nothing holds it.
ClothSpec looseSheet(double height) {
    ClothSpec cloth = support::cloth("c", 8);
    cloth.size = {0.4, 0.4};
    cloth.origin = {-0.2, height, -0.2};
    cloth.down = {0, 0, 1};
    cloth.thickness = apart;
    cloth.material = "m";
    return cloth;
}

SceneSpec sceneOf(const ClothSpec& cloth, const figure::Figure& figure) {
    SceneSpec scene;
    scene.materials["m"].stretch = 200;
    scene.materials["m"].bend = 0.5;
    scene.bodies.add(cloth);
    scene.colliders = {colliderOf(figure)};
    return scene;
}

dvec3 meanVelocity(const World& world) {
    dvec3 sum(0.0);
    const PointsNow points = world.points("cloth.c");
    for (const dvec3& v : points.v) sum += v / static_cast<double>(points.v.size());
    return sum;
}

TEST(Figure, AMovingFaceDragsWhatLiesOnItByFriction) {
    figure::Figure belt = boxes({{0, -0.1, 0}}, {2, 0.2, 0.6}, 5);
    animate(belt, 0, Path::translation, {0, 1}, {0, -0.1, 0, 1, -0.1, 0});
    SceneSpec scene = sceneOf(looseSheet(apart), belt);
    scene.colliders[0].friction = 0.2;
    scene.materials["m"].drag = 0;
    World world(scene);
    run(world, 6);
    const double before = meanVelocity(world).x;
    run(world, 12);
    // It slides: Coulomb's μ g, until it goes with the belt at 1 m/s.
    const double expected = 0.2 * support::g * 12 / 60;
    EXPECT_NEAR(meanVelocity(world).x - before, expected, 0.01 * expected);
    run(world, 40);
    EXPECT_NEAR(meanVelocity(world).x, 1.0, 1e-3);
    EXPECT_GT(world.metrics().contacts, 0);
    EXPECT_EQ(world.metrics().facePenetration, 0.0);
}

TEST(Figure, AFastFacePassesThroughNothing) {
    figure::Figure bat = boxes({{0, -0.5, 0}}, {1, 0.01, 1}, 2);
    animate(bat, 0, Path::translation, {0, 0.1}, {0, -0.5, 0, 0, 0.7, 0});  // 12 m/s upwards
    World world(sceneOf(looseSheet(0.0), bat));
    for (int tick = 0; tick < 12; ++tick) {
        run(world, 1);
        EXPECT_EQ(world.metrics().crossings, 0) << tick;
    }
    for (const dvec3& x : world.points("cloth.c").x) EXPECT_GT(x.y, 0.7);
}

TEST(Figure, PointsSqueezedByTwoPartsAreLetThroughAndComeFree) {
    // Two boxes close upon a sheet that hangs between them until they overlap by 2 cm, and part again.
    figure::Figure press = boxes({{-0.3, 0, 0}, {0.3, 0, 0}}, {0.2, 0.2, 0.2}, 4);
    animate(press, 0, Path::translation, {0.1, 0.5, 0.8, 1.2}, {-0.3, 0, 0, -0.09, 0, 0, -0.09, 0, 0, -0.3, 0, 0});
    animate(press, 1, Path::translation, {0.1, 0.5, 0.8, 1.2}, {0.3, 0, 0, 0.09, 0, 0, 0.09, 0, 0, 0.3, 0, 0});
    ClothSpec cloth = support::cloth("c", 16);
    cloth.size = {0.6, 0.6};
    cloth.origin = {0, 0.3, -0.3};
    cloth.across = {0, 0, 1};
    cloth.thickness = apart;
    cloth.material = "m";
    cloth.hold = {"top"};
    World world(sceneOf(cloth, press));
    double fastest = 0;
    int squeezed = 0;
    for (int tick = 0; tick < 72; ++tick) {
        run(world, 1);
        for (const dvec3& v : world.points("cloth.c").v) fastest = std::max(fastest, glm::length(v));
        squeezed = std::max(squeezed, world.metrics().squeezed);
    }
    EXPECT_GT(squeezed, 10);
    EXPECT_LT(fastest, 2.5);  // nothing is thrown out; the boxes move at 0.5 m/s, and a fall by 0.3 m gives 2.4 m/s
    run(world, 60);
    EXPECT_EQ(world.metrics().squeezed, 0);
    EXPECT_EQ(world.metrics().crossings, 0);
    for (const dvec3& x : world.points("cloth.c").x) EXPECT_LT(std::abs(x.x), 0.2);  // in neither
}

TEST(Figure, AJointAndTheSkinCarryPoints) {
    // A quarter turn about y in a second, seen from above against the clock.
    figure::Figure arm = boxes({{0, 0, 0}}, {1, 0.1, 1}, 2);
    const double half = std::sqrt(0.5);
    animate(arm, 0, Path::rotation, {0, 1}, {0, 0, 0, 1, 0, half, 0, half});
    for (const char* holder : {"collider.f.box0", "collider.f.\"box0\"", "collider.f"}) {
        ClothSpec cloth = looseSheet(0.3);
        cloth.hold = {"left"};
        cloth.holdOn = holder;
        World world(sceneOf(cloth, arm));
        const PointsNow start = world.points("cloth.c@left");
        run(world, 20);
        const double angle = 0.5 * core::pi * world.time(), c = core::cosine(angle), s = core::sine(angle);
        const PointsNow now = world.points("cloth.c@left");
        for (std::size_t i = 0; i < now.x.size(); ++i) {
            const dvec3& p = start.x[i];
            const dvec3 expected(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
            EXPECT_LT(glm::length(now.x[i] - expected), 1e-6) << holder;  // of the cloth's single precision
        }
    }
}

TEST(Figure, ASavedStateGoesOnWithTheSameBits) {
    figure::Figure belt = boxes({{0, -0.1, 0}}, {2, 0.2, 0.6}, 5);
    animate(belt, 0, Path::translation, {0, 0.2, 0.5}, {0, 0, 0, 0, 0.1, 0, 0.3, 0, 0});
    const SceneSpec scene = sceneOf(looseSheet(0.03), belt);
    for (const int stop : {15, 30}) {  // as it moves, and as it stops
        World world(scene);
        run(world, stop);
        World other(scene);
        other.restore(world.save());
        run(world, 15);
        run(other, 15);
        EXPECT_EQ(world.stateHash(), other.stateHash()) << stop;
    }
}

TEST(Figure, WakesWhatSleepsInItsWay) {
    figure::Figure belt = boxes({{0, -1, 0}}, {1, 0.02, 1}, 3);
    animate(belt, 0, Path::translation, {0, 2, 2.5}, {0, -1, 0, 0, -1, 0, 0, 0.2, 0});
    ClothSpec cloth = looseSheet(0.0);
    cloth.hold = {"all"};
    SceneSpec scene = sceneOf(cloth, belt);
    scene.solver.sleepError = 1e-3;
    scene.bodies.add([] {
        ClothSpec free = looseSheet(apart);
        free.name = "free";
        free.touch = Touch::others;
        return free;
    }());
    (*scene.bodies.begin()).touch = Touch::others;
    World world(scene);
    run(world, 119);
    EXPECT_GT(world.asleepShare(), 0.0);
    run(world, 36);
    for (const dvec3& x : world.points("cloth.free").x) EXPECT_GT(x.y, 0.2);
}

// ---- animations alone ----

TEST(Figure, KeysAreJoinedAsGltfSaysThatTheyAre) {
    figure::Channel cubic{0, Path::translation, figure::Interpolation::cubic, {1, 3}, {}};
    // t³ of its first coordinate, t² of the second, t of the third: a cubic spline has them exactly.
    for (const double t : {1.0, 3.0}) {
        const std::vector<double> slope{3 * t * t, 2 * t, 1}, value{t * t * t, t * t, t};
        for (const auto* part : {&slope, &value, &slope})
            cubic.values.insert(cubic.values.end(), part->begin(), part->end());
    }
    std::array<double, 3> x{};
    figure::sample(cubic, 3, 2.5, x);
    EXPECT_NEAR(x[0], 15.625, 1e-14);
    EXPECT_NEAR(x[1], 6.25, 1e-14);
    EXPECT_NEAR(x[2], 2.5, 1e-14);

    // A rotation goes evenly the short way: from 0 to -160 degrees about x, given by the opposite quaternion.
    const double angle = core::radians(-160.0);
    const figure::Channel turn{0,
                               Path::rotation,
                               figure::Interpolation::linear,
                               {0, 1},
                               {0, 0, 0, 1, -core::sine(angle / 2), 0, 0, -core::cosine(angle / 2)}};
    std::array<double, 4> q{};
    for (const double share : {0.1, 0.37, 0.9}) {
        figure::sample(turn, 4, share, q);
        EXPECT_NEAR(q[0], core::sine(share * angle / 2), 1e-15);
        EXPECT_NEAR(q[3], core::cosine(share * angle / 2), 1e-15);
    }

    const figure::Channel steps{0, Path::scale, figure::Interpolation::step, {0, 1, 2}, {1, 1, 1, 2, 2, 2, 3, 3, 3}};
    figure::sample(steps, 3, 1.999, x);
    EXPECT_EQ(x[0], 2.0);
}

}  // namespace
}  // namespace taut::world
