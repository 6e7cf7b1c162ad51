// Hands: pulling by springs, leading exactly, letting go, and the order of the methods through all of it.
#include <gtest/gtest.h>

#include <cmath>

#include "support/timelines.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/core/error.h"
#include "taut/core/trig.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

using support::run;

using support::g;

// A mass of 2 kg that nothing but gravity acts on: its spring, to a wall, is without force to speak of.
SceneSpec handledMass(const std::string& method = "leapfrog", double stiffness = 1e-9) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.solver.integrator = method;
    NetSpec net;
    net.name = "ball";
    net.drag = 0;
    net.points = {{"m", {0, 0, 0}, 2.0, false, {}}, {"wall", {0, 0, 1}, 1.0, true, {}}};
    net.springs = {{"m", "wall", stiffness, 1.0, 5e-3, {}}};
    scene.bodies.add(net);
    return scene;
}

TEST(Hands, ASpringHandLetsItsLoadSagByWeightOverStrength) {
    SceneSpec scene = handledMass();
    auto grab = support::grab(0.0, "net.ball@m");
    grab.strength = 150;
    grab.dampingRatio = 1;  // the slower of its rates is √(K/m) = 8.7/s
    scene.actions = {grab};
    World world(scene);
    run(world, 240);
    EXPECT_NEAR(world.points("net.ball@m").x[0].y, -2 * g / 150, 1e-9);
    EXPECT_EQ(world.handPlace("hand"), dvec3(0.0));
    EXPECT_EQ(world.handPlace("nobody"), std::nullopt);
}

// K is that of the whole hand, however many points it holds, and shared by mass: all sag alike and the body keeps
// its shape.
TEST(Hands, AHandSharesItsStrengthByMassAndKeepsTheShape) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.bodies.add(support::cloth("sheet", 4));
    auto grab = support::grab(0.0, "cloth.sheet");
    grab.strength = 40;
    grab.dampingRatio = 1;
    scene.actions = {grab};
    World world(scene);
    const PointsNow before = world.points("cloth.sheet");
    run(world, 240);
    const PointsNow after = world.points("cloth.sheet");
    const double sag = 0.2 * g / 40;  // a square metre of 0.2 kg
    for (std::size_t i = 0; i < before.x.size(); ++i)
        EXPECT_NEAR(glm::length(after.x[i] - (before.x[i] - dvec3(0, sag, 0))), 0, 1e-9) << i;
}

TEST(Hands, TheRadiusTakesWhatIsNearAndNearTakesTheNearest) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.bodies.add(support::cloth("sheet", 4));  // a point every 25 cm
    // A push moves all points but the ones that a rigid hand has.
    const auto takenBy = [&](GrabAction grab) {
        grab.rigid = true;
        World world(scene);
        world.apply(grab);
        world.apply(support::push(0.0, "cloth.sheet", {0, 0, 1}));
        int count = 0;
        for (const dvec3& v : world.points("cloth.sheet").v) count += v == dvec3(0.0) ? 1 : 0;
        return count;
    };
    auto corner = support::grab(0.0, "cloth.sheet@bottom-right");
    EXPECT_EQ(takenBy(corner), 1);
    corner.radius = 0.26;
    EXPECT_EQ(takenBy(corner), 3);  // and its neighbours along both edges
    corner.radius = 0.36;
    EXPECT_EQ(takenBy(corner), 4);  // and the one across
    auto somewhere = support::grab(0.0, "cloth.sheet");
    somewhere.near = dvec3(0.95, 1.02, 0.4);
    EXPECT_EQ(takenBy(somewhere), 1);
    somewhere.radius = 0.26;
    EXPECT_EQ(takenBy(somewhere), 3);
}

TEST(Hands, ARigidHandIsFollowedExactly) {
    for (const Ease ease : {Ease::linear, Ease::smooth, Ease::in, Ease::out}) {
        SceneSpec scene;
        scene.solver.precision = Precision::double_;
        scene.bodies.add(support::cloth("sheet", 4));
        scene.actions = {support::grab(0.1, "cloth.sheet@top", true),
                         support::moveHand(0.2, {0.7, 2.5, 0.5}, 0.4, ease)};
        World world(scene);
        run(world, 6);
        const std::vector<dvec3> start = world.points("cloth.sheet@top").x;
        run(world, 1);
        const dvec3 place = *world.handPlace("hand");
        for (int i = 0; i < 40; ++i) {
            run(world, 1);
            const double u = std::clamp((world.time() - 0.2) / 0.4, 0.0, 1.0);
            const double share = ease == Ease::linear   ? u
                                 : ease == Ease::smooth ? u * u * (3 - 2 * u)
                                 : ease == Ease::in     ? u * u
                                                        : u * (2 - u);
            const dvec3 expected = place + share * (dvec3(0.7, 2.5, 0.5) - place);
            EXPECT_NEAR(glm::length(*world.handPlace("hand") - expected), 0, 1e-12);
            const PointsNow now = world.points("cloth.sheet@top");
            for (std::size_t p = 0; p < start.size(); ++p)
                EXPECT_NEAR(glm::length(now.x[p] - start[p] - (*world.handPlace("hand") - place)), 0, 1e-12);
        }
    }
}

// Four turns of 360 degrees, in angles and not the short way.
MoveAction turnHand(double t, dvec3 angles, double over, Ease ease) {
    MoveAction turn = support::moveHand(t, {0, 0, 0}, over, ease);
    turn.to.reset();
    turn.rotation = angles;
    return turn;
}

TEST(Hands, PointsInATurningHandGoRoundAsOftenAsItTurns) {
    for (const bool isRigid : {true, false}) {
        SceneSpec scene;
        scene.world.gravity = dvec3(0.0);
        scene.solver.precision = Precision::double_;
        scene.bodies.add(support::cloth("sheet", 2));
        auto grab = support::grab(0.0, "cloth.sheet", isRigid);
        grab.strength = 1e5;
        grab.dampingRatio = 1;
        scene.actions = {grab, turnHand(0.0, {8 * core::pi, 0, 0}, 1.5, Ease::smooth)};
        World world(scene);
        const std::vector<dvec3> start = world.points("cloth.sheet").x;
        run(world, 1);
        const dvec3 hand = *world.handPlace("hand");
        double turned = 0;
        dvec3 before = start[0] - hand;
        for (int i = 1; i < 90; ++i) {
            run(world, 1);
            const dvec3 arm = world.points("cloth.sheet").x[0] - hand;
            turned += std::atan2(before.y * arm.z - before.z * arm.y, before.y * arm.y + before.z * arm.z);
            before = arm;
        }
        run(world, isRigid ? 0 : 60);  // until springs have led it there
        const std::vector<dvec3> end = world.points("cloth.sheet").x;
        const double tolerance = isRigid ? 1e-14 : 1e-9;
        for (std::size_t p = 0; p < start.size(); ++p) EXPECT_NEAR(glm::length(end[p] - start[p]), 0, tolerance);
        EXPECT_NEAR(turned, 8 * core::pi, isRigid ? 0.01 : 0.1);  // less the first tick, and the lag of springs
    }
}

// Held at both ends and wrung, a cloth is as much the one way as the other: half a turn about its axis changes nothing,
// as long as it does not buckle.
TEST(Hands, TwoHandsWringAClothEvenly) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = Precision::double_;
    scene.bodies.add(support::cloth("sheet", 4));
    auto left = support::grab(0.0, "cloth.sheet@left", true), right = support::grab(0.0, "cloth.sheet@right", true);
    auto turnLeft = turnHand(0.0, {0.4, 0, 0}, 0.2, Ease::smooth), turnRight = turnLeft;
    right.id = turnRight.id = "other";
    turnRight.rotation = dvec3(-0.4, 0, 0);
    scene.actions = {left, right, turnLeft, turnRight};
    World world(scene);
    run(world, 12);
    const std::vector<dvec3> x = world.points("cloth.sheet").x;
    EXPECT_NEAR(x[0].z, 0.5 * std::sin(0.4), 1e-12);
    EXPECT_NEAR(x[4].z, -0.5 * std::sin(0.4), 1e-12);
    const dvec3 middle = 0.5 * (*world.handPlace("hand") + *world.handPlace("other"));
    for (std::size_t row = 0; row < 5; ++row)
        for (std::size_t column = 0; column < 5; ++column) {
            const dvec3 a = x[5 * row + column] - middle, b = x[5 * (4 - row) + column] - middle;
            EXPECT_NEAR(glm::length(b - dvec3(a.x, -a.y, -a.z)), 0, 1e-6) << row << ' ' << column;
        }
}

TEST(Hands, AHandThatWouldTurnTooFarInATickIsRefused) {
    SceneSpec scene = handledMass();
    World world(scene);
    world.apply(support::grab(0.0, "net.ball@m"));
    const auto whyNot = [&](const MoveAction& turn) -> std::string {
        try {
            world.apply(turn);
        } catch (const core::Error& error) {
            return error.what();
        }
        return "";
    };
    const double turns = 8 * core::pi;
    EXPECT_EQ(whyNot(turnHand(0.0, {turns, 0, 0}, 0.0, Ease::smooth)),
              "timeline.toml:7:3: error: the hand would turn by 1.44e+03 degrees in a tick of 1/60 s; raise over_s, so "
              "that it is 120 at most");
    EXPECT_NE(whyNot(turnHand(0.0, {turns, 0, 0}, 0.25, Ease::smooth)), "");  // 144 degrees in the middle
    EXPECT_EQ(whyNot(turnHand(0.0, {turns, 0, 0}, 0.25, Ease::linear)), "");  // 96
    EXPECT_NE(whyNot(turnHand(0.0, {0, 0, turns}, 9.0, Ease::hold)), "");
}

class EveryMethodLetsGo : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethodLetsGo,
                         testing::Values("euler", "symplectic-euler", "heun", "midpoint", "rk4", "velocity-verlet",
                                         "leapfrog", "blanes-moan", "implicit-euler", "sdirk2"),
                         [](const testing::TestParamInfo<std::string_view>& parameter) {
                             std::string name(parameter.param);
                             for (char& c : name)
                                 if (c == '-') c = '_';
                             return name;
                         });

TEST_P(EveryMethodLetsGo, PointsReleasedByARigidHandFlyOnWithTheirSpeed) {
    SceneSpec scene = handledMass(std::string(GetParam()));
    scene.world.gravity = dvec3(0.0);
    scene.bodies.of<NetSpec>()[0].springs[0].dampingTime = 0;
    scene.solver.dt = 1.0 / 240;
    scene.actions = {support::grab(0.0, "net.ball@m", true), support::moveHand(0.0, {3, 0, 0}, 1.0, Ease::linear),
                     support::release(0.5)};
    World world(scene);
    run(world, 30);
    EXPECT_NEAR(world.points("net.ball@m").v[0].x, 3.0, 1e-12);
    run(world, 30);
    const PointsNow now = world.points("net.ball@m");
    EXPECT_NEAR(now.v[0].x, 3.0, 1e-8);  // but for the spring of 1e-9 N/m
    EXPECT_NEAR(now.x[0].x, 3.0, 1e-8);
    EXPECT_EQ(world.handPlace("hand"), std::nullopt);
}

TEST(Hands, LettingGoOfASpringHandKeepsTheMomentum) {
    SceneSpec scene = handledMass();
    scene.world.gravity = dvec3(0.0);
    scene.actions = {support::grab(0.0, "net.ball@m"), support::moveHand(0.0, {1, 0.5, 0}, 0.3), support::release(0.2)};
    World world(scene);
    run(world, 12);
    const dvec3 before = world.metrics().momentum;
    EXPECT_GT(glm::length(before), 0.5);
    run(world, 1);
    EXPECT_NEAR(glm::length(world.metrics().momentum - before), 0, 1e-9);
    run(world, 100);
    EXPECT_NEAR(glm::length(world.metrics().momentum - before), 0, 1e-8);
}

// A mass of 2 kg, and a hand 5 m above it that pulls with this share of its weight at most.
SceneSpec slippingMass(double share) {
    SceneSpec scene = handledMass();
    auto grab = support::grab(0.0, "net.ball@m");
    grab.strength = 150;  // as hard from 13 cm on, or from 20
    grab.dampingRatio = 0;
    grab.maxForce = share * 2 * g;
    scene.actions = {grab, support::moveHand(0.0, {0, 5, 0}, 0.0)};
    return scene;
}

// a = F/m - g, which methods integrate without error.
TEST(Hands, AHandLiftsWithItsLargestForceAndNothingThatIsHeavier) {
    for (const double share : {0.5, 1.5}) {
        World world(slippingMass(share));
        run(world, 2);
        const double before = world.points("net.ball@m").v[0].y;
        run(world, 30);
        EXPECT_NEAR(world.points("net.ball@m").v[0].y - before, (share - 1) * g * 0.5, 1e-8);  // the wall: 1e-9 N/m
    }
}

// Its energy has that force as slope: swinging to and fro about the hand, from 5 m below it, the mass loses none.
TEST(Hands, AHandThatSlipsKeepsTheEnergy) {
    SceneSpec scene = slippingMass(1.5);
    scene.solver.dt = 1e-4;
    World world(scene);
    run(world, 2);
    const double before = world.metrics().energy();
    double highest = 0;
    for (int i = 0; i < 600; ++i) {
        run(world, 1);
        highest = std::max(highest, world.points("net.ball@m").x[0].y);
        // (h ω)² / 8 = 1e-7 of 144 J; seen is 1.1e-5 J. A force that is cut without its energy would lose 80 J.
        EXPECT_NEAR(world.metrics().energy(), before, 3e-5);
    }
    EXPECT_GT(highest, 5.0);
}

TEST(Hands, ASavedHandSlipsOn) {
    const SceneSpec scene = slippingMass(1.5);
    World whole(scene), begun(scene), restored(scene);
    run(whole, 40);
    run(begun, 20);
    restored.restore(begun.save());
    run(restored, 20);
    EXPECT_EQ(restored.stateHash(), whole.stateHash());
}

// Where m is after a second of: pulled by a hand that comes and goes, pushed, released, held and freed, with gravity
// changing. Its own spring swings at 1.6 Hz with a dashpot.
dvec3 placeAfterEvents(const std::string& method, int substeps) {
    SceneSpec scene = handledMass(method, 200.0);
    scene.solver.dt = 1.0 / 60 / substeps;
    auto grab = support::grab(0.1, "net.ball@m");
    grab.strength = 120;
    scene.actions = {
        grab,
        support::moveHand(0.1, {0.3, 0.2, 0.1}, 0.3),
        support::ramp(0.15, "world.gravity", fields::Affects::forces, 4.0, 0.4, Ease::smooth,
                      [](SceneSpec& s) -> double& { return s.world.gravity.y; }),
        support::push(0.3, "net.ball@m", {0.5, 1.0, -0.4}),
        support::ramp(0.35, "net.ball.stiffness", fields::Affects::springs, 350.0, 0.2, Ease::linear,
                      [](SceneSpec& s) -> double& { return s.bodies.of<NetSpec>()[0].springs[0].stiffness; }),
        support::moveHand(0.5, {-0.2, 0.1, 0.3}, 0.2, Ease::linear),
        support::release(0.8),
    };
    World world(scene);
    run(world, 60);
    return world.points("net.ball@m").x[0];
}

class OrderThroughEvents : public testing::TestWithParam<std::pair<std::string_view, int>> {};
INSTANTIATE_TEST_SUITE_P(Methods, OrderThroughEvents,
                         testing::Values(std::pair{"leapfrog", 2}, std::pair{"velocity-verlet", 2},
                                         std::pair{"midpoint", 2}, std::pair{"heun", 2}, std::pair{"rk4", 4},
                                         std::pair{"blanes-moan", 4}, std::pair{"sdirk2", 2}),
                         [](const testing::TestParamInfo<std::pair<std::string_view, int>>& parameter) {
                             std::string name(parameter.param.first);
                             for (char& c : name)
                                 if (c == '-') c = '_';
                             return name;
                         });

// Against Runge-Kutta 4 at steps so short that it is exact to about 1e-11. Without a fresh start at every event the
// order of leap-frog falls to 1.
TEST_P(OrderThroughEvents, IsThatOfTheMethod) {
    const auto& [method, order] = GetParam();
    const dvec3 exact = placeAfterEvents("rk4", 48);
    const double coarse = glm::length(placeAfterEvents(std::string(method), 3) - exact);
    const double fine = glm::length(placeAfterEvents(std::string(method), 6) - exact);
    const double measured = std::log2(coarse / fine);
    EXPECT_NEAR(measured, order, 0.35) << coarse << ' ' << fine;  // of steps that are not yet very short
    EXPECT_LT(fine, 2e-3);
}

}  // namespace
}  // namespace taut::world
