// Every action by a small scene with a known answer, and the message of one that finds nothing to act on.
#include <gtest/gtest.h>

#include <cmath>

#include "support/timelines.h"
#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/bodies/rope.h"
#include "taut/core/error.h"
#include "taut/ode/method_table.h"
#include "taut/world/components.h"

namespace taut::world {
namespace {

using support::action;
using support::run;

// Masses of 1 and 3 kg on a spring in empty space.
SceneSpec dumbbell() {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = Precision::double_;
    NetSpec net;
    net.name = "pair";
    net.drag = 0;
    net.points = {{"a", {0, 0, 0}, 1.0, false, {}}, {"b", {1, 0, 0}, 3.0, false, {}}};
    net.springs = {{"a", "b", 100.0, std::nullopt, std::nullopt, {}}};
    scene.bodies.add(net);
    return scene;
}

// One mass of 2 kg, free in empty space, or under gravity; tied by a spring of no force to one that is held.
SceneSpec loneMass(const std::string& method = "leapfrog") {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.solver.integrator = method;
    NetSpec net;
    net.name = "ball";
    net.drag = 0;
    net.points = {{"m", {0, 0, 0}, 2.0, false, {}}, {"wall", {0, 0, 5}, 1.0, true, {}}};
    net.springs = {{"m", "wall", 1e-9, 5.0, std::nullopt, {}}};
    scene.bodies.add(net);
    return scene;
}

std::string errorOf(const SceneSpec& scene, int ticks = 3) {
    try {
        World world(scene);
        for (int i = 0; i < ticks; ++i) (void)world.advance();
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        return error.what();
    }
    return "";
}

class EveryMethodActs : public testing::TestWithParam<std::string_view> {};
std::string nameOfMethod(const testing::TestParamInfo<std::string_view>& parameter) {
    std::string name(parameter.param);
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
}
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethodActs,
                         testing::Values("euler", "symplectic-euler", "heun", "midpoint", "rk4", "velocity-verlet",
                                         "leapfrog", "blanes-moan", "implicit-euler", "sdirk2"),
                         nameOfMethod);

// A change by a system at the start of a tick equals an action of that tick.
TEST_P(EveryMethodActs, APushFromASystemIsThatOfAnAction) {
    SceneSpec scene = loneMass(std::string(GetParam()));
    scene.solver.dt = 1.0 / 240;
    auto push = action<PushAction>(0.1, "net.ball@m");
    push.impulse = {0, 0.6, 0};
    World fromSystem(scene);
    fromSystem.addSystem([&](World& world, double, double) {
        if (world.tick() == 6) world.apply(push);
    });
    scene.actions = {push};
    World fromAction(scene);
    run(fromSystem, 20);
    run(fromAction, 20);
    EXPECT_EQ(fromSystem.stateHash(), fromAction.stateHash());
}

TEST_P(EveryMethodActs, APushChangesTheVelocityOfEveryPointByTheImpulseOverTheMass) {
    SceneSpec scene = dumbbell();
    scene.solver.integrator = std::string(GetParam());
    scene.solver.dt = 1.0 / 240;
    scene.actions = {support::push(0.05, "net.pair", {0.8, -0.4, 0.2})};
    World world(scene);
    run(world, 3);
    for (const dvec3& v : world.points("net.pair").v) EXPECT_EQ(v, dvec3(0.0));
    run(world, 1);
    // J/M = (0.2, -0.1, 0.05) for both, so that nothing strains the spring; to rounding.
    for (const dvec3& v : world.points("net.pair").v) EXPECT_NEAR(glm::length(v - dvec3(0.2, -0.1, 0.05)), 0, 1e-12);
    EXPECT_NEAR(glm::length(world.metrics().momentum - dvec3(0.8, -0.4, 0.2)), 0, 1e-12);
    run(world, 30);
    const PointsNow now = world.points("net.pair@a");
    EXPECT_NEAR(glm::length(now.x[0] - dvec3(0.2, -0.1, 0.05) * (31.0 / 60)), 0, 1e-9);
}

TEST_P(EveryMethodActs, AnImpulseOnAPartOfABodyIsItsMomentum) {
    SceneSpec scene = dumbbell();
    scene.solver.integrator = std::string(GetParam());
    scene.solver.dt = 1.0 / 960;
    scene.actions = {support::push(0.05, "net.pair@b", {0, 0.6, 0})};
    World world(scene);
    run(world, 20);
    // Momentum to rounding, of implicit Euler to the tolerance of its solves.
    EXPECT_NEAR(glm::length(world.metrics().momentum - dvec3(0, 0.6, 0)), 0,
                GetParam() == "implicit-euler" || GetParam() == "sdirk2" ? 1e-5 : 1e-12);
}

TEST(Actions, AHeldPointStaysToTheBitAndAFreedOneFalls) {
    SceneSpec scene = loneMass();
    scene.actions = {action<HoldAction>(0.1, "net.ball@m"), action<FreeAction>(0.3, "net.ball@m")};
    World world(scene);
    run(world, 7);
    const dvec3 held = world.points("net.ball@m").x[0];
    EXPECT_NEAR(held.y, -0.5 * 9.81 * 0.01, 1e-12);  // free fall for 0.1 s, which leap-frog has exactly
    EXPECT_EQ(world.points("net.ball@m").v[0], dvec3(0.0));
    run(world, 11);
    EXPECT_EQ(world.points("net.ball@m").x[0], held);
    run(world, 12);
    EXPECT_NEAR(world.points("net.ball@m").x[0].y - held.y, -0.5 * 9.81 * 0.2 * 0.2, 1e-12);
}

// At rest m g = k x: 2 kg and then 5 kg on 500 N/m.
TEST(Actions, AddedMassMovesTheEquilibrium) {
    SceneSpec scene = loneMass();
    scene.bodies.of<NetSpec>()[0].points[1].position = {0, 1, 0};
    scene.bodies.of<NetSpec>()[0].points[0].mass = 2;
    scene.bodies.of<NetSpec>()[0].springs[0] = {"m", "wall", 500.0, 1.0, std::nullopt, {}};
    scene.bodies.of<NetSpec>()[0].drag = 8;
    auto more = action<AddMassAction>(4.0, "net.ball@m");
    more.mass = 3;
    scene.actions = {more};
    World world(scene);
    run(world, 240);
    EXPECT_NEAR(world.points("net.ball@m").x[0].y, -2 * 9.81 / 500, 1e-6);  // e^{-4·4} of the start
    EXPECT_EQ(world.points("net.ball@m").mass[0], 2.0);
    run(world, 240);
    EXPECT_NEAR(world.points("net.ball@m").x[0].y, -5 * 9.81 / 500, 1e-6);
    EXPECT_EQ(world.points("net.ball@m").mass[0], 5.0);
    // The wall has 1 kg at a height of 1 m.
    EXPECT_NEAR(world.metrics().gravitational, 9.81 * (5 * world.points("net.ball@m").x[0].y + 1), 1e-9);
}

TEST(Actions, AddedMassIsSharedByThePointsAndKeepsTheirVelocities) {
    SceneSpec scene = dumbbell();
    auto more = action<AddMassAction>(0.1, "net.pair");
    more.mass = 2;
    scene.actions = {support::push(0.0, "net.pair", {0, 4, 0}), more};
    World world(scene);
    run(world, 8);
    EXPECT_EQ(world.points("net.pair").mass, (std::vector<double>{2.0, 4.0}));
    EXPECT_NEAR(world.metrics().momentum.y, 6.0, 1e-12);
}

TEST(Actions, ASpawnedBodyIsNotThereBeforeAndThenFalls) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.bodies.add(support::rope("first", {0, 3, 0}, {1, 3, 0}, 4), support::rope("late", {0, 3, 2}, {1, 3, 2}, 4));
    for (RopeSpec& rope : scene.bodies.of<RopeSpec>()) rope.drag = 0;
    scene.actions = {action<SpawnAction>(0.1, "rope.late")};
    World world(scene);
    EXPECT_EQ(world.islands().size(), 1U);
    EXPECT_EQ(world.view(false).surfaces.size(), 1U);
    EXPECT_TRUE(world.points("rope.late").x.empty());
    run(world, 6);
    EXPECT_EQ(world.islands().size(), 1U);
    run(world, 6);
    EXPECT_EQ(world.islands().size(), 2U);
    EXPECT_EQ(world.view(false).surfaces.size(), 2U);
    // As the first after the same time, to rounding: it is at other times.
    const double fallen = 3 - 0.5 * 9.81 * 0.01;
    for (const dvec3& x : world.points("rope.late").x) EXPECT_NEAR(x.y, fallen, 1e-12);
}

TEST(Actions, AMovedColliderIsWhereItIsSentOnTheWayThatTheEasingHas) {
    for (const auto& [ease, half] :
         {std::pair{Ease::linear, 0.5}, {Ease::in, 0.25}, {Ease::out, 0.75}, {Ease::smooth, 0.5}, {Ease::hold, 0.0}}) {
        SceneSpec scene;
        scene.colliders = {support::ball("ball", {0, 1, 0}, 0.3)};
        auto move = action<MoveAction>(0.1, "collider.ball");
        move.to = dvec3(2, 1, 0);
        move.over = 0.2;
        move.ease = ease;
        scene.actions = {move};
        World world(scene);
        const auto x = [&] { return static_cast<double>(world.view(false).surfaces[0].transform[3].x); };
        run(world, 6);
        EXPECT_EQ(x(), 0.0);
        run(world, 6);
        EXPECT_NEAR(x(), 2 * half, 1e-6);  // of a picture's floats
        run(world, 6);
        EXPECT_EQ(x(), 2.0);
        run(world, 20);
        EXPECT_EQ(x(), 2.0);
    }
}

TEST(Actions, AMovedColliderTurnsFromWhereItsKeyframesHaveBroughtIt) {
    SceneSpec scene;
    ColliderSpec box = support::ball("box", {0, 1, 0}, 0.3);
    box.shape = "box";
    box.keys = {{0.0, {0, 1, 0}, dvec3(0.0), Ease::linear}, {1.0, {6, 1, 0}, dvec3(0.0), Ease::linear}};
    scene.colliders = {box};
    auto turn = action<MoveAction>(0.5, "collider.box");
    turn.rotation = dvec3(0, 1.2, 0);
    turn.over = 0.1;
    scene.actions = {turn};
    World world(scene);
    run(world, 60);
    const glm::mat4 pose = world.view(false).surfaces[0].transform;
    EXPECT_NEAR(pose[3].x, 3.0, 1e-6);  // where it was when told to turn
    EXPECT_NEAR(pose[0].x, std::cos(1.2), 1e-6);
}

TEST(Actions, AFloorThatWillTiltIsDrawnAsABoard) {
    SceneSpec scene;
    scene.colliders = {support::ground()};
    EXPECT_TRUE(World(scene).view(false).ground);
    auto tilt = action<MoveAction>(0.1, "collider.ground");
    tilt.rotation = dvec3(0, 0, 0.2);
    scene.actions = {tilt};
    EXPECT_FALSE(World(scene).view(false).ground);
    EXPECT_EQ(World(scene).view(false).surfaces.size(), 1U);
}

// Over no time a collider is moved within a tick: swept, as if it had flown, and nothing is thrown.
TEST(Actions, AColliderThatIsSentAtOnceDoesNotTearClothApart) {
    SceneSpec scene;
    scene.bodies.add(support::cloth("sheet", 10));
    scene.bodies.of<ClothSpec>()[0].hold = {"top"};
    scene.colliders = {support::ball("ball", {0.5, 1.5, 1.0}, 0.3)};
    auto move = action<MoveAction>(0.1, "collider.ball");
    move.to = dvec3(0.5, 1.5, -0.2);
    scene.actions = {move};
    World world(scene);
    run(world, 60);
    EXPECT_EQ(world.metrics().penetration, 0.0);
    EXPECT_LT(world.metrics().maxStrain, 1.0);
    double furthest = 0;
    for (const dvec3& x : world.points("cloth.sheet").x)
        furthest = std::max(furthest, glm::length(x - dvec3(0.5, 1.5, 0)));
    EXPECT_LT(furthest, 1.5);  // it hangs where it hung, about the ball
}

TEST(Actions, PenetrationIsTheDepthInsideAColliderBeforeContactTakesItAway) {
    SceneSpec scene = loneMass();
    scene.bodies.of<NetSpec>()[0].collide = true;
    scene.colliders = {support::ball("ball", {0, 0.1, 0}, 0.4)};
    World world(scene);
    EXPECT_NEAR(world.metrics().penetration, 0.3, 1e-12);
    run(world, 1);
    EXPECT_NEAR(world.metrics().penetration, 0.3 - 1.0 / 60, 1e-9);  // out at 1 m/s
    run(world, 18);
    EXPECT_EQ(world.metrics().penetration, 0.0);
}

TEST(Actions, VolumeIsThatOfTheBlocks) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    BlockSpec block;
    block.name = "brick";
    block.size = {0.5, 0.4, 0.3};
    scene.bodies.add(block);
    EXPECT_NEAR(World(scene).metrics().volume, 0.06, 1e-12);
    EXPECT_NEAR(World(scene).metrics().restVolume, 0.06, 1e-12);
    block.name = "other";
    scene.bodies.add(block);
    EXPECT_NEAR(World(scene).metrics().volume, 0.12, 1e-12);
    EXPECT_NEAR(World(scene).metrics("block.other").volume, 0.06, 1e-12);
    EXPECT_EQ(World(scene).metrics("rope.*").volume, 0.0);
}

TEST(Actions, HashesOfBodiesAndPointsTellWhatDiffers) {
    SceneSpec scene;
    scene.bodies.add(support::rope("a", {0, 3, 0}, {1, 3, 0}, 4), support::rope("b", {0, 3, 2}, {1, 3, 2}, 4));
    SceneSpec other = scene;
    other.actions = {support::push(0.0, "rope.b@#2", {0, 0, 1e-3})};
    World one(scene), two(other);
    run(one, 1);
    run(two, 1);
    const std::vector<BodyHash> first = one.bodyHashes(), second = two.bodyHashes();
    ASSERT_EQ(first.size(), 2U);
    EXPECT_EQ(first[0].name, "rope.a");
    EXPECT_EQ(first[0].hash, second[0].hash);
    EXPECT_NE(first[1].hash, second[1].hash);
    ecs::Entity a, b;
    one.registry().each<Identity>([&](ecs::Entity entity, const Identity& identity) {
        if (identity.name == "a") a = entity;
        if (identity.name == "b") b = entity;
    });
    EXPECT_EQ(one.pointHashes(a), two.pointHashes(a));
    EXPECT_NE(one.pointHashes(b)[2], two.pointHashes(b)[2]);
    EXPECT_EQ(one.pointHashes(b).size(), 5U);
}

// The timeline, and the same actions given by hand between the ticks, as a mouse would.
TEST(Actions, GivenByHandTheyDoTheSameAsOnATimeline) {
    const SceneSpec scene = support::everythingHappens();
    World timeline(scene), byHand(scene);
    SceneSpec nothing = scene;
    // Steps and bodies that wait come from the timeline: so its times alone are taken away.
    for (ActionSpec& a : nothing.actions) a.t = 1e6;
    World live(nothing);
    for (int tick = 0; tick < 30; ++tick) {
        for (const ActionSpec& a : scene.actions)
            if (static_cast<int>(std::floor(a.t * 60 + 0.5)) == tick) live.apply(a);
        ASSERT_FALSE(timeline.advance());
        ASSERT_FALSE(live.advance());
        ASSERT_EQ(timeline.stateHash(), live.stateHash()) << tick;
    }
}

// Looking between the ticks changes nothing, not even while actions wait.
TEST(Actions, QuestionsChangeNothing) {
    const SceneSpec scene = support::everythingHappens();
    World asked(scene), silent(scene);
    for (int tick = 0; tick < 30; ++tick) {
        if (tick == 10) {
            asked.apply(support::push(0, "rope.line", {0, 0.1, 0}));
            silent.apply(support::push(0, "rope.line", {0, 0.1, 0}));
        }
        (void)asked.metrics();
        (void)asked.points("cloth.*");
        (void)asked.view(true);
        (void)asked.bodyHashes();
        (void)asked.islands();
        (void)asked.save();
        ASSERT_FALSE(asked.advance());
        ASSERT_FALSE(silent.advance());
        ASSERT_EQ(asked.stateHash(), silent.stateHash()) << tick;
    }
}

TEST(ActionErrors, NameTheActionsPlaceInItsFile) {
    SceneSpec scene = dumbbell();
    scene.actions = {support::push(0.0, "net.nobody", {1, 0, 0})};
    EXPECT_NE(errorOf(scene).find("timeline.toml:7:3: error: target = \"net.nobody\" names no point"),
              std::string::npos)
        << errorOf(scene);
    scene.actions = {support::moveHand(0.0, {0, 0, 0}, 1)};
    EXPECT_NE(errorOf(scene).find("timeline.toml:7:3: error: there is no hand \"hand\""), std::string::npos);
    scene.actions = {support::release(0.0)};
    EXPECT_NE(errorOf(scene).find("there is no hand \"hand\""), std::string::npos);
    scene.actions = {support::grab(0.0, "net.pair@a"), support::grab(0.0, "net.pair@b")};
    EXPECT_NE(errorOf(scene).find("there is a hand \"hand\" already"), std::string::npos);
    scene.actions = {action<HoldAction>(0.0, "net.pair"), support::grab(0.0, "net.pair@b")};
    EXPECT_NE(errorOf(scene).find("is held already"), std::string::npos);
    scene.actions = {action<MoveAction>(0.0, "collider.nothing")};
    EXPECT_NE(errorOf(scene).find("no collider \"collider.nothing\""), std::string::npos);
    scene.actions = {action<SpawnAction>(0.0, "net.pair"), action<SpawnAction>(0.0, "net.pair")};
    EXPECT_NE(errorOf(scene).find("no body \"net.pair\" waits"), std::string::npos);
    auto lighter = action<AddMassAction>(1e3, "net.pair");
    lighter.mass = -2.5;
    scene.actions = {lighter};
    EXPECT_NE(errorOf(scene, 0).find("without any mass"), std::string::npos);  // long before it happens
}

TEST(ActionErrors, ASpawnedBodyCannotBeTied) {
    SceneSpec scene;
    scene.bodies.add(support::rope("a", {0, 3, 0}, {1, 3, 0}, 4), support::rope("b", {1, 3, 0}, {2, 3, 0}, 4));
    scene.joints = {support::weld("rope.a@end", "rope.b@start", 0.02, {"tied.toml", 3, 1})};
    EXPECT_EQ(errorOf(scene, 0), "");
    scene.actions = {action<SpawnAction>(1.0, "rope.b")};
    EXPECT_NE(errorOf(scene, 0).find("tied.toml:3:1: error: \"rope.b@start\" ties rope.b, which is spawned later"),
              std::string::npos)
        << errorOf(scene, 0);
}

}  // namespace
}  // namespace taut::world
