// Sleep: a resting island is not computed, stays within the error of the run that never sleeps, and wakes when it has
// to.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/scenes.h"
#include "support/timelines.h"
#include "taut/bodies/net.h"
#include "taut/core/private/hash.h"
#include "taut/forces/wind.h"
#include "taut/island/private/rest_bound.h"
#include "taut/joints/joints.h"
#include "taut/world/private/impl.h"

namespace taut::world {
namespace {

using test::positionsOf;

constexpr double allowed = 1e-4;  // [m] sleep_error_m

SceneSpec sleepy() {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.solver.sleepError = allowed;
    return scene;
}

// 0.4 m wide, hung up by its upper edge or its corners, so damped that it comes to rest within two seconds.
ClothSpec sheet(const std::string& name, const dvec3& origin, const dvec3& down) {
    ClothSpec cloth;
    cloth.name = name;
    cloth.size = {0.4, 0.4};
    cloth.cells = {4, 4};
    cloth.origin = origin;
    cloth.down = down;
    cloth.thickness = 0.004;
    return cloth;
}
SceneSpec curtain() {
    SceneSpec scene = sleepy();
    ClothSpec cloth = sheet("curtain", {0, 1, 0}, {0, -1, 0});
    cloth.hold = {"top"};
    cloth.velocity = {0, 0, 0.1};
    scene.materials["still"].drag = 6.0;
    scene.materials["still"].bend = 0.1;
    cloth.material = "still";
    scene.bodies.add(cloth);
    return scene;
}

// Two sheets on the ground, the upper one turned.
SceneSpec pile() {
    SceneSpec scene = sleepy();
    scene.materials["still"].drag = 6.0;
    scene.materials["still"].bend = 0.1;
    scene.colliders.push_back(support::ground());
    scene.colliders.back().friction = 0.5;
    for (int k = 0; k < 2; ++k) {
        ClothSpec cloth = sheet(k == 0 ? "lower" : "upper", {0.03 * k, 0.006 + 0.01 * k, 0.02 * k}, {0, 0, 1});
        cloth.across = k == 0 ? dvec3(1, 0, 0) : glm::normalize(dvec3(1, 0, 0.3));
        cloth.down = k == 0 ? dvec3(0, 0, 1) : glm::normalize(dvec3(-0.3, 0, 1));
        cloth.material = "still";
        cloth.touch = Touch::others;
        scene.bodies.add(cloth);
    }
    return scene;
}

NetSpec particle(const std::string& name, const dvec3& place, const dvec3& velocity, double mass = 0.05) {
    NetSpec net;
    net.name = name;
    net.points = {{"only", place, mass, false, {}}};
    net.velocity = velocity;
    net.drag = 0.0;
    net.touch = Touch::others;
    net.thickness = 0.004;
    return net;
}

bool sleeps(const World& world) {
    return world.asleepShare() == 1.0;
}

// Ticks until all sleeps; -1: not within `seconds`.
int untilAsleep(World& world, double seconds) {
    const int last = static_cast<int>(seconds / world.tickSeconds() + 0.5);
    for (int i = 1; i <= last; ++i) {
        EXPECT_FALSE(world.advance());
        if (sleeps(world)) return i;
    }
    return -1;
}

double furthest(World& a, World& b, const std::vector<std::string>& bodies) {
    double most = 0;
    for (const std::string& name : bodies) {
        const std::vector<dvec3> x = positionsOf(a, name), y = positionsOf(b, name);
        for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, glm::distance(x[i], y[i]));
    }
    return most;
}

// Both run for eight seconds. Once asleep, every tick is compared.
void expectWithinError(SceneSpec scene, const std::vector<std::string>& bodies, double asleepWithin) {
    World sleeping(scene);
    scene.solver.sleepError = 0;
    World waking(scene);
    const int fallen = untilAsleep(sleeping, asleepWithin);
    ASSERT_GT(fallen, 0);
    const std::vector<dvec3> kept = positionsOf(sleeping, bodies[0]);
    test::advance(waking, fallen);
    double most = furthest(sleeping, waking, bodies);
    EXPECT_EQ(most, 0.0);  // nothing differs until it falls asleep
    while (waking.time() < 8.0) {
        ASSERT_FALSE(sleeping.advance());
        ASSERT_FALSE(waking.advance());
        most = std::max(most, furthest(sleeping, waking, bodies));
    }
    EXPECT_LE(most, allowed);
    EXPECT_TRUE(sleeps(sleeping));
    EXPECT_EQ(positionsOf(sleeping, bodies[0]), kept);
}

TEST(Sleep, AHangingClothStaysWithinTheErrorOfTheRunThatNeverSleeps) {
    expectWithinError(curtain(), {"cloth.curtain"}, 6.0);
}

TEST(Sleep, SheetsThatLieOnEachOtherStayWithinTheErrorOfTheRunThatNeverSleeps) {
    expectWithinError(pile(), {"cloth.lower", "cloth.upper"}, 4.0);
}

// Blocks of 0.1 m on the ground, one on the other a little aside.
TEST(Sleep, ATowerStaysWithinTheErrorOfTheRunThatNeverSleeps) {
    SceneSpec scene = sleepy();
    scene.colliders.push_back(support::ground());
    for (int k = 0; k < 2; ++k) {
        BlockSpec block;
        block.name = k == 0 ? "low" : "high";
        block.size = {0.1, 0.1, 0.1};
        block.cells = {2, 2, 2};
        block.position = {0.004 * k, 0.056 + 0.111 * k, 0.003 * k};
        block.young = 1e5;
        block.bulk = 1e5;
        block.density = 300;
        block.drag = 4.0;
        block.dampingTime = 2e-3;
        block.touch = Touch::others;
        scene.bodies.add(block);
    }
    expectWithinError(scene, {"block.low", "block.high"}, 4.0);
}

// A panel that hangs on another by a seam, with so many cells along it.
SceneSpec sewnCurtain(int cells) {
    SceneSpec scene = curtain();
    ClothSpec lower = sheet("lower", {0, 0.599, 0}, {0, -1, 0});
    lower.material = "still";
    lower.cells = {cells, 4};
    scene.bodies.add(lower);
    SeamJoint hem;
    hem.name = "hem";
    hem.a = "cloth.curtain@bottom";
    hem.b = "cloth.lower@top";
    hem.over = 0.5;
    scene.joints.add(hem);
    return scene;
}

// Points of a seam move as one, or as the places between them: masses and holds of the two edges add up.
TEST(Sleep, APanelSewnToAnotherStaysWithinTheErrorAndFallsWhenTheSeamIsReleased) {
    for (const int cells : {4, 7}) expectWithinError(sewnCurtain(cells), {"cloth.curtain", "cloth.lower"}, 7.0);

    World world(sewnCurtain(4));
    ASSERT_GT(untilAsleep(world, 7.0), 0);
    const double height = positionsOf(world, "cloth.lower")[12].y;
    auto release = support::release(0);
    release.id = "hem";
    world.apply(release);
    test::advance(world, 30);
    EXPECT_LT(positionsOf(world, "cloth.lower")[12].y, height - 0.1);
}

// An oscillator swings by v/ω and rests at f/k. A chain of three between walls has the compliance of its stiffness
// matrix [2 -1 0; -1 2 -1; 0 -1 2] k: the middle goes f/k · 1.
TEST(RestBound, IsTheAmplitudeAndTheWayToEquilibrium) {
    constexpr double k = 50.0, m = 0.02, v = 0.3, f = 0.7;
    const auto spring = [](std::span<const dvec3> u, std::span<dvec3> sum) { sum[0] += k * u[0]; };
    const std::vector<double> inverse{1.0 / m};
    const std::vector<dvec3> none{dvec3(0.0)}, fast{{v, 0, 0}}, pulled{{0, f, 0}};
    EXPECT_NEAR(restBound(inverse, none, fast, none, 0.0, spring), v / std::sqrt(k / m), 1e-12);
    EXPECT_NEAR(restBound(inverse, none, fast, pulled, 0.0, spring), v / std::sqrt(k / m) + f / k, 1e-12);
    const mechanics::StiffnessProduct chain = [](std::span<const dvec3> u, std::span<dvec3> sum) {
        for (std::size_t i = 0; i < 3; ++i)
            sum[i] += k * (2.0 * u[i] - (i > 0 ? u[i - 1] : dvec3(0.0)) - (i < 2 ? u[i + 1] : dvec3(0.0)));
    };
    const std::vector<dvec3> still(3, dvec3(0.0)), middle{dvec3(0.0), {0, f, 0}, dvec3(0.0)};
    const std::vector<double> three(3, 1.0 / m);
    EXPECT_NEAR(restBound(three, still, still, middle, 1e-9, chain), f / k, 1e-8);
}

TEST(RestBound, IsInfiniteWhereNothingDrawsBack) {
    const std::vector<double> free{1.0, 1.0}, tied{1.0, 0.0};
    const std::vector<dvec3> zero(2, dvec3(0.0));
    const auto tie = [](double k) {
        return [k](std::span<const dvec3> u, std::span<dvec3> sum) {
            sum[0] += k * (u[0] - u[1]);
            sum[1] += k * (u[1] - u[0]);
        };
    };
    EXPECT_TRUE(std::isinf(restBound(free, zero, zero, zero, 1e-9, tie(3.0))));   // it may go as a whole
    EXPECT_TRUE(std::isinf(restBound(tied, zero, zero, zero, 1e-9, tie(-3.0))));  // pressed out of balance
    EXPECT_LT(restBound(tied, zero, zero, zero, 1e-9, tie(3.0)), 1e-8);
}

// At rest to the bit, but nothing would stop it: a particle without weight, and one on ground without friction.
TEST(Sleep, BodiesWithoutARestoringForceStayAwake) {
    for (const bool isOnGround : {false, true}) {
        SceneSpec scene = sleepy();
        if (!isOnGround) scene.world.gravity = dvec3(0.0);
        scene.colliders.push_back(support::ground());
        scene.colliders.back().friction = 0.0;
        scene.bodies.add(particle("one", {0, isOnGround ? 0.004 : 1.0, 0}, dvec3(0.0)));
        World world(scene);
        EXPECT_EQ(untilAsleep(world, 4.0), -1) << isOnGround;
    }
}

// Friction between sheets does not hold them where the ground has none.
TEST(Sleep, APileOnIceStaysAwake) {
    SceneSpec scene = pile();
    scene.colliders.back().friction = 0.0;
    World world(scene);
    EXPECT_EQ(untilAsleep(world, 4.0), -1);
    EXPECT_EQ(world.asleepShare(), 0.0);
}

TEST(Sleep, AGustKeepsAwakeAndASteadyWindDoesNot) {
    for (const bool gusts : {false, true}) {
        SceneSpec scene = curtain();
        WindSpec wind;
        wind.name = "air";
        wind.velocity = {0, 0, 0.2};
        wind.lift = 0.0;
        wind.gustAmplitude = gusts ? 1e-3 : 0.0;
        scene.forces.add(wind);
        scene.materials["still"].drag = 20.0;
        World world(scene);
        EXPECT_EQ(untilAsleep(world, 8.0) < 0, gusts);
    }
}

// Each cause wakes the curtain before the tick moves it. Each is given to a world that sleeps.
TEST(Sleep, AHandAPushARampAndAColliderWakeWithinTheTick) {
    SceneSpec scene = curtain();
    scene.colliders.push_back(support::ball("ball", {0.2, 0.8, 2.0}, 0.1));
    World asleep(scene);
    ASSERT_GT(untilAsleep(asleep, 8.0), 0);
    const std::vector<std::byte> state = asleep.save();
    const auto wakes = [&](const std::vector<std::function<void(World&)>>& doings) {
        World world(scene);
        world.restore(state);
        EXPECT_TRUE(sleeps(world));
        for (const auto& doing : doings) {
            doing(world);
            EXPECT_FALSE(world.advance());
        }
        return !sleeps(world);
    };
    EXPECT_FALSE(wakes({[](World&) {}}));
    EXPECT_TRUE(wakes({[](World& w) { w.apply(support::push(0, "cloth.curtain@bottom", {0, 0, 1e-3})); }}));
    const auto draw = [](World& w) {
        w.apply(support::ramp(0, "world.gravity.y", fields::Affects::forces, -9.0, 1.0, Ease::linear,
                              [](SceneSpec& s) -> double& { return s.world.gravity.y; }));
    };
    EXPECT_TRUE(wakes({draw}));
    EXPECT_TRUE(wakes({[](World& w) { w.apply(support::grab(0, "cloth.curtain@bottom-left")); }}));
    const auto sendBall = [](const dvec3& to) {
        return [to](World& w) {
            w.registry().each<ColliderPart, Placement>([&](ecs::Entity, ColliderPart& part, Placement& place) {
                part.move = PoseMove{place.to, {to, place.to.rotation}, w.tick(), 1, Ease::linear};
            });
        };
    };
    EXPECT_FALSE(wakes({sendBall({0.2, 0.8, 1.5})}));
    EXPECT_TRUE(wakes({sendBall({0.2, 0.8, 0.05})}));
    EXPECT_TRUE(wakes({[](World& w) { w.spawn(support::ball("other", {5, 5, 5}, 0.1)); }}));
}

// Without sleep: contacts that began each tick without their forces sank by 2e-6 m a tick.
TEST(Sleep, APileComesToRestByItself) {
    SceneSpec scene = pile();
    scene.solver.sleepError = 0;
    World world(scene);
    test::advance(world, static_cast<int>(4.5 / world.tickSeconds()));
    const std::vector<dvec3> before = positionsOf(world, "cloth.upper");
    test::advance(world, 10);
    const std::vector<dvec3> after = positionsOf(world, "cloth.upper");
    for (std::size_t i = 0; i < after.size(); ++i) EXPECT_LT(glm::distance(before[i], after[i]), 1e-9) << i;
}

// In the tick in which the ball is slowed down, the sheets are awake, and all is where it is without sleep. Until then
// they sleep.
TEST(Sleep, AFallingBallWakesThePileWithinTheTick) {
    SceneSpec scene = pile();
    World world(scene);
    const int fallen = untilAsleep(world, 5.0);
    ASSERT_GT(fallen, 0);
    scene.solver.sleepError = 0;
    World waking(scene);
    test::advance(waking, fallen);
    for (World* one : {&world, &waking}) one->spawn(particle("ball", {0.2, 0.1, 0.2}, {0, -1, 0}));
    double before = -1.0;
    for (int i = 0; i < 60; ++i) {
        EXPECT_EQ(world.metrics("cloth.*").asleep, 50);
        ASSERT_FALSE(world.advance());
        ASSERT_FALSE(waking.advance());
        const double speed = world.points("net.ball").v[0].y;
        if (speed > before) break;
        before = speed;
    }
    EXPECT_EQ(world.metrics("cloth.*").asleep, 0);
    EXPECT_LE(furthest(world, waking, {"cloth.lower", "cloth.upper", "net.ball"}), allowed);
}

TEST(Sleep, BodiesThatLoseTheirSupportFall) {
    World world(pile());
    ASSERT_GT(untilAsleep(world, 5.0), 0);
    const double height = positionsOf(world, "cloth.upper")[12].y;
    world.destroy(test::bodyOf(world, "cloth.lower"));
    test::advance(world, 30);
    EXPECT_LT(positionsOf(world, "cloth.upper")[12].y, height - 0.004);
}

TEST(Sleep, IsInTheHashTheStateAndGoesOnFromIt) {
    SceneSpec scene = pile();
    scene.actions.add(support::push(6.0, "cloth.upper", {0, 0.01, 0.01}));
    World whole(scene);
    ASSERT_GT(untilAsleep(whole, 5.0), 0);
    const std::vector<std::byte> state = whole.save();
    World resumed(scene, {.threads = 3});
    resumed.restore(state);
    EXPECT_EQ(resumed.save(), state);
    bool hasWoken = false;
    while (whole.time() < 9.0) {
        ASSERT_FALSE(whole.advance());
        ASSERT_FALSE(resumed.advance());
        ASSERT_EQ(whole.stateHash(), resumed.stateHash()) << whole.tick();
        hasWoken = hasWoken || !sleeps(whole);
    }
    EXPECT_TRUE(hasWoken);
    scene.solver.sleepError = 0;
    World other(scene);
    EXPECT_THROW(other.restore(state), core::Error);
}

TEST(Sleep, IsGreyInTheDebugViewAlone) {
    World world(curtain());
    EXPECT_EQ(world.view(true).surfaces.front().greyed, 0.0F);
    ASSERT_GT(untilAsleep(world, 6.0), 0);
    EXPECT_EQ(world.view(false).surfaces.front().greyed, 0.0F);
    EXPECT_GT(world.view(true).surfaces.front().greyed, 0.5F);
    EXPECT_EQ(world.metrics().asleep, 25);
    EXPECT_EQ(world.metrics().kinetic, 0.0);
}

TEST(Sleep, WithoutAnErrorNothingSleepsAndWithKeptStepsNeither) {
    SceneSpec scene = curtain();
    World kept(scene, {.keepsSteps = true});
    EXPECT_EQ(untilAsleep(kept, 6.0), -1);
    scene.solver.sleepError = 0;
    World none(scene);
    EXPECT_EQ(untilAsleep(none, 6.0), -1);
}

// 1e5 times: random pushes, asleep, awake. The energy of the pushes equals the energy taken by falling asleep, to
// rounding.
TEST(Sleep, BooksTheMomentumAndTheEnergyThatItTakes) {
    SceneSpec scene = sleepy();
    scene.world.gravity = dvec3(0.0);
    scene.bodies.add(particle("one", dvec3(0.0), dvec3(0.0), 0.3));
    World world(scene);
    WorldImpl& w = WorldAccess::of(world);
    Island& island = *w.islands.front();
    dvec3 momentum(0.0);
    double energy = 0, size = 0;
    std::uint64_t seed = 1;
    const std::vector<int> points{0};
    for (int i = 0; i < 100000; ++i) {
        dvec3 v;
        for (int k = 0; k < 3; ++k) v[k] = static_cast<double>(core::mixed(++seed)) * 0x1p-63 - 1.0;
        island.push(w.now(), points, v);
        island.fallAsleep(w.now(), 1);
        EXPECT_TRUE(island.isAsleep());
        island.wake();
        momentum += 0.3 * v;
        size += 0.3 * glm::length(v);
        energy += 0.5 * 0.3 * glm::dot(v, v);
    }
    EXPECT_LT(glm::length(island.slept().momentum - momentum), 1e-13 * size);
    EXPECT_NEAR(island.slept().energy, energy, 1e-12 * energy);
    EXPECT_EQ(island.position(0), dvec3(0.0));
}

}  // namespace
}  // namespace taut::world
