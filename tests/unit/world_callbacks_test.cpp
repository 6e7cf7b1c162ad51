// Forces and systems that are functions of the program, and ticks that they break off.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "support/timelines.h"
#include "taut/bodies/net.h"
#include "taut/core/private/parallel.h"
#include "taut/forces/callback.h"
#include "taut/world/undoing_world.h"

namespace taut::world::callbacks_test {
namespace {

// `count` free masses of 2 kg in a row along x, each an island of its own beside a held point.
SceneSpec freeMasses(int count, Precision precision) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = precision;
    for (int i = 0; i < count; ++i) {
        NetSpec net;
        net.name = "ball" + std::to_string(i);
        net.drag = 0;
        net.points = {{"m", {0.5 + i, 0, 0}, 2.0, false, {}}, {"wall", {0.5 + i, 0, 5}, 1.0, true, {}}};
        net.springs = {{"m", "wall", 1e-9, {}, {}, {}}};
        scene.bodies.add(net);
    }
    return scene;
}

CallbackSpec pull(double stiffness) {
    CallbackSpec spec{"force.well"};
    spec.targets = {"net.*@m"};
    spec.force = [=](const CallbackPoints& points, std::span<dvec3> f) {
        for (std::size_t i = 0; i < f.size(); ++i) f[i] = -stiffness * points.x[i];
    };
    spec.energy = [=](const CallbackPoints& points, std::span<double> e) {
        for (std::size_t i = 0; i < e.size(); ++i) e[i] = 0.5 * stiffness * glm::dot(points.x[i], points.x[i]);
    };
    spec.stiffness = stiffness;
    return spec;
}

// As of a force in C++: 72 N/m on 2 kg is ω = 6/s, of which leap-frog's phase is 3e-3 off after 1 s at h = 1/60 s.
TEST(CallbackForce, MovesAMassInBothPrecisionsAndItsEnergyIsCounted) {
    for (Precision precision : {Precision::single_, Precision::double_}) {
        World world(freeMasses(1, precision));
        world.addForce(callbackForce(pull(72.0)));
        support::run(world, 60);
        const double x = world.points("net.ball0@m").x[0].x;
        EXPECT_NEAR(x, 0.5 * std::cos(6.0), 2e-3);
        EXPECT_NEAR(world.metrics("net.ball0").elastic, 0.5 * 72.0 * x * x, 1e-4);
    }
}

// 1e6 N/m on 2 kg is ω = 707/s; ω h is kept to 1.5, of which a tick of 16.7 ms takes eight.
TEST(CallbackForce, HasAShareInTheStepsBoundIfItSaysHowStiffItIs) {
    const World world(freeMasses(1, Precision::double_), {.forces = {callbackForce(pull(1e6))}});
    EXPECT_EQ(world.islands()[0].substeps, 8);
}

TEST(CallbackForce, IsAskedForOneIslandAfterAnotherInTheirOrder) {
    World world(freeMasses(8, Precision::single_), {.threads = 4});
    std::atomic<int> inside = 0;
    std::vector<double> order;
    bool wasAlone = true;
    CallbackSpec spec{"force.none"};
    spec.targets = {"net.*@m"};
    spec.force = [&](const CallbackPoints& points, std::span<dvec3>) {
        wasAlone = wasAlone && ++inside == 1;
        if (order.empty() || order.back() != points.x[0].x) order.push_back(points.x[0].x);
        --inside;
    };
    world.addForce(callbackForce(spec));
    (void)world.advance();  // which starts methods anew
    order.clear();
    (void)world.advance();
    EXPECT_TRUE(wasAlone);
    EXPECT_EQ(order, (std::vector{0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5}));
}

TEST(CallbackForce, EndsThePromiseOfEqualBitsAndTheWorldSaysSo) {
    World world(freeMasses(1, Precision::single_));
    EXPECT_TRUE(world.callbacks().empty());
    world.addForce(callbackForce(pull(1.0)));
    world.addSystem([](World&, double, double) {}, "lead");
    EXPECT_EQ(world.callbacks(), (std::vector<std::string>{"lead", "force.well"}));
    ASSERT_EQ(world.warnings().size(), 2U);
    EXPECT_NE(world.warnings()[1].text.find("force.well is a callback"), std::string::npos) << world.warnings()[1].text;
}

TEST(CallbackForce, ThatIsNotFiniteIsNamedWithItsPointAndMoment) {
    World world(freeMasses(1, Precision::single_));
    CallbackSpec spec = pull(0.0);
    spec.force = [](const CallbackPoints& points, std::span<dvec3> f) { f[0].y = 1.0 / (points.t < 0.1 ? 1.0 : 0.0); };
    world.addForce(callbackForce(spec));
    try {
        for (int i = 0; i < 10; ++i) (void)world.advance();
        FAIL() << "went on";
    } catch (const core::Error& error) {
        EXPECT_NE(
            std::string(error.what()).find("force.well: its force on point 0 of net.ball0 at 0.1 s is not finite"),
            std::string::npos)
            << error.what();
    }
}

// A scene in which everything happens that can, and a force or a system that throws in every tick, from the first call
// on or a later one. A repeated tick without the exception has the same result as an undisturbed one.
class Undoing : public testing::TestWithParam<bool> {};

TEST_P(Undoing, ATickThatThrowsHasNotHappenedWhateverItHasDone) {
    const bool isSystem = GetParam();
    const auto make = [&](int& left) {
        auto world = std::make_unique<UndoingWorld>(support::everythingHappens());
        const auto count = [&left] {
            if (left == 1) throw std::runtime_error("enough");  // whenever it is asked again
            if (left > 1) --left;
        };
        CallbackSpec spec = pull(1.0);
        spec.targets = {"rope.line", "cloth.sheet"};
        spec.force = [count, isSystem](const CallbackPoints& points, std::span<dvec3> f) {
            if (!isSystem) count();
            for (std::size_t i = 0; i < f.size(); ++i) f[i] = -0.1 * points.x[i];
        };
        world->addForce(spec);
        world->addSystem(
            [count, isSystem, to = world.get()](World&, double t, double) {
                to->place("collider.ball", {{-1.2, 1.2 + t, 0.0}});
                if (isSystem) count();
            },
            "lead");
        return world;
    };
    int never = 0, left = 0;
    const auto smooth = make(never), broken = make(left);
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE(i);
        const std::vector<std::byte> before = broken->world().save();
        left = isSystem ? 1 : 1 + i % 3;
        EXPECT_THROW((void)broken->advance(), std::runtime_error);
        EXPECT_EQ(broken->world().save(), before);
        left = 0;
        ASSERT_FALSE(broken->advance());
        ASSERT_FALSE(smooth->advance());
        ASSERT_EQ(broken->world().stateHash(), smooth->world().stateHash());
    }
}

INSTANTIATE_TEST_SUITE_P(ByForceAndBySystem, Undoing, testing::Bool());

TEST(UndoingWorld, RefusesAnActionWithoutATraceAndRestoresARampThatNoSceneForesaw) {
    const SceneSpec scene = support::everythingHappens();
    SceneSpec bare = scene;
    bare.actions.clear();
    UndoingWorld world(bare);
    (void)world.advance();
    const std::vector<std::byte> before = world.world().save();
    EXPECT_THROW(world.apply(support::moveHand(0, {0, 0, 0}, 0.1)), core::Error) << "there is no such hand";
    EXPECT_EQ(world.world().save(), before);
    EXPECT_THROW(world.place("collider.bowl", {}), core::Error);

    world.apply(support::ramp(0, "world.gravity", fields::Affects::forces, -4.0, 0.2, Ease::smooth,
                              [](SceneSpec& s) -> double& { return s.world.gravity.y; }));
    for (int i = 0; i < 5; ++i) ASSERT_FALSE(world.advance());
    UndoingWorld again(bare);
    EXPECT_THROW(again.restore(world.world().save()), core::Error) << "it knows no ramp";
    EXPECT_EQ(again.world().tick(), 0);
    again.restore(world.world().save(), world.applied());
    for (UndoingWorld* each : {&world, &again})
        for (int i = 0; i < 5; ++i) ASSERT_FALSE(each->advance());
    EXPECT_EQ(again.world().stateHash(), world.world().stateHash());
}

// Of two actions that are due the first is done and the second finds no hand.
TEST(UndoingWorld, GoesBackFromATickWhoseActionCannotBeDone) {
    SceneSpec scene = freeMasses(1, Precision::double_);
    scene.actions = {support::push(0.1, "net.ball0@m", {1, 0, 0}), support::release(0.1)};
    UndoingWorld world(scene);
    for (int i = 0; i < 6; ++i) ASSERT_FALSE(world.advance());
    EXPECT_THROW((void)world.advance(), core::Error);
    EXPECT_EQ(world.world().tick(), 6);
    EXPECT_EQ(world.world().metrics().momentum.x, 0.0);
}

// 0.1 m in a tick, through a mass that is 0.05 m before the ball's face: at its end it stands on the face.
TEST(UndoingWorld, LeadsAColliderThatPushesWhatIsInItsWay) {
    SceneSpec scene = freeMasses(1, Precision::double_);
    scene.colliders = {support::ball("ball", {0.25, 0, 0}, 0.2)};
    UndoingWorld world(scene);
    world.place("collider.ball", {{0.35, 0, 0}});
    (void)world.advance();
    EXPECT_EQ(world.poseOf("collider.ball").position.x, 0.35);
    EXPECT_GE(world.world().points("net.ball0@m").x[0].x, 0.55 - 1e-9);
}

}  // namespace
}  // namespace taut::world::callbacks_test
