// A step that stays allows for all that a timeline will do, from the first tick to the last.
#include <gtest/gtest.h>

#include <cmath>

#include "support/timelines.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/forces/wind.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

using support::action;

// A cloth of light points; leap-frog's limit is 2/ω without dashpots.
SceneSpec hanging() {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    MaterialSpec silk;
    silk.stretch = 40;
    silk.dampingTime = 0;
    scene.materials = {{"silk", silk}};
    scene.bodies.add(support::cloth("sheet", 8));
    scene.bodies.of<ClothSpec>()[0].material = "silk";
    scene.bodies.of<ClothSpec>()[0].hold = {"top"};
    return scene;
}

ode::FastestMode modeOf(const SceneSpec& scene) {
    return World(scene).islands()[0].fastest;
}
double stepLimitOf(const SceneSpec& scene) {
    return World(scene).islands()[0].stepLimit;
}

TEST(Envelope, ATimelineThatStiffensNothingChangesNoStep) {
    SceneSpec scene = hanging();
    const double limit = stepLimitOf(scene);
    auto more = action<AddMassAction>(1.0, "cloth.sheet");
    more.mass = 1;
    scene.actions = {support::push(0.5, "cloth.sheet", {0, 0, 1}),
                     more,
                     support::grab(1.5, "cloth.sheet@bottom", true),
                     action<HoldAction>(2.0, "cloth.sheet@bottom"),
                     support::cutPlane(3.0, "cloth.sheet", {0.51, 0, 0}, {1, 0, 0}),
                     support::ramp(1.0, "material.silk.stretch", fields::Affects::springs, 20.0, 1.0, Ease::linear,
                                   [](SceneSpec& s) -> double& { return s.materials["silk"].stretch; })};
    EXPECT_EQ(stepLimitOf(scene), limit);
}

// A hand of K on a grip of M adds K/M to ω² and 2ζ√(K/M) to the damping.
TEST(Envelope, AHandAddsItsRates) {
    SceneSpec scene = hanging();
    const ode::FastestMode before = modeOf(scene);
    auto grab = support::grab(1.0, "cloth.sheet@bottom-right");
    grab.strength = 300;
    grab.dampingRatio = 0.25;
    scene.actions = {grab};
    const double mass = 0.2 / 64 / 4;  // of a corner [kg]
    ode::FastestMode after = modeOf(scene);
    EXPECT_NEAR(after.omega * after.omega, before.omega * before.omega + 300 / mass, 1e-6 * after.omega * after.omega);
    EXPECT_NEAR(after.rate - before.rate, 2 * 0.25 * std::sqrt(300 / mass), 1e-6 * after.rate);

    // Two hands at a time on the same points count both; one after the other of the same name count once.
    scene.actions = {grab, support::release(2.0), grab};
    EXPECT_EQ(modeOf(scene).omega, after.omega);
    GrabAction other = grab;
    other.id = "other";
    scene.actions = {grab, other};
    after = modeOf(scene);
    EXPECT_NEAR(after.omega * after.omega, before.omega * before.omega + 600 / mass, 1e-6 * after.omega * after.omega);

    // Where hands may be anywhere, the lightest point tells.
    scene.actions = {};
    scene.hand = {true, 300, 0.25};
    after = modeOf(scene);
    EXPECT_NEAR(after.omega * after.omega, before.omega * before.omega + 300 / mass, 1e-6 * after.omega * after.omega);
}

TEST(Envelope, RampsOfStiffnessCountAtTheirLargest) {
    SceneSpec scene = hanging();
    SceneSpec stiff = scene;
    stiff.materials["silk"].stretch = 160;
    const auto stretch = [](SceneSpec& s) -> double& { return s.materials["silk"].stretch; };
    scene.actions = {
        support::ramp(1.0, "material.silk.stretch", fields::Affects::springs, 160, 1.0, Ease::linear, stretch),
        support::ramp(2.0, "material.silk.stretch", fields::Affects::springs, 10, 1.0, Ease::linear, stretch)};
    EXPECT_EQ(stepLimitOf(scene), stepLimitOf(stiff));
    EXPECT_LT(stepLimitOf(scene), stepLimitOf(hanging()));
}

// Symplectic Euler bears more with drag, and dashpots lower its limit: the least of the one and the most of the other.
TEST(Envelope, DampingCountsAtItsWorst) {
    SceneSpec scene = hanging();
    scene.solver.integrator = "symplectic-euler";
    scene.materials["silk"].drag = 5;
    SceneSpec worst = scene;
    worst.materials["silk"].drag = 1;
    worst.materials["silk"].dampingTime = 2e-3;
    scene.actions = {support::ramp(1.0, "material.silk.drag", fields::Affects::springs, 1, 1.0, Ease::linear,
                                   [](SceneSpec& s) -> double& { return s.materials["silk"].drag; }),
                     support::ramp(1.0, "material.silk.damping", fields::Affects::springs, 2e-3, 1.0, Ease::linear,
                                   [](SceneSpec& s) -> double& { return s.materials["silk"].dampingTime; })};
    EXPECT_EQ(stepLimitOf(scene), stepLimitOf(worst));
}

TEST(Envelope, PointsThatAreFreedCountAsFree) {
    SceneSpec never = hanging();
    never.bodies.of<ClothSpec>()[0].hold = {};
    SceneSpec scene = hanging();
    scene.bodies.of<ClothSpec>()[0].hold = {"all"};
    scene.actions = {action<FreeAction>(1.0, "cloth.sheet")};
    EXPECT_EQ(stepLimitOf(scene), stepLimitOf(never));
    // A heavy point and a light one, which is held: ω² = k/4 kg, and k/4 kg + k/10 g once it is free.
    SceneSpec rope;
    rope.solver.precision = Precision::double_;
    NetSpec net;
    net.name = "pair";
    net.points = {{"heavy", {0, 0, 0}, 4.0, false, {}}, {"light", {1, 0, 0}, 0.01, true, {}}};
    net.springs = {{"heavy", "light", 100.0, std::nullopt, std::nullopt, {}}};
    rope.bodies.add(net);
    const double before = stepLimitOf(rope);
    rope.actions = {action<FreeAction>(1.0, "net.pair@light")};
    EXPECT_NEAR(stepLimitOf(rope), 2 / std::sqrt(100 / 4.0 + 100 / 0.01), 1e-9);
    EXPECT_GT(before, 5 * stepLimitOf(rope));
}

TEST(Envelope, MassThatIsTakenAwayCountsAsGone) {
    SceneSpec scene = hanging();
    auto less = action<AddMassAction>(1.0, "cloth.sheet@bottom-right");
    less.mass = -0.5 * 0.2 / 64 / 4;
    scene.actions = {less};
    EXPECT_LT(stepLimitOf(scene), 0.95 * stepLimitOf(hanging()));
}

TEST(Envelope, WindsCountAtTheirFastest) {
    SceneSpec scene = hanging();
    WindSpec wind;
    wind.name = "breeze";
    wind.velocity = {6, 0, 0};
    scene.forces.add(wind);
    SceneSpec gale = scene;
    gale.forces.of<WindSpec>()[0].velocity = {25, 0, 0};
    scene.actions = {support::ramp(1.0, "wind.breeze.velocity", fields::Affects::forces, 25, 1.0, Ease::linear,
                                   [](SceneSpec& s) -> double& { return s.forces.of<WindSpec>()[0].velocity.x; })};
    EXPECT_EQ(stepLimitOf(scene), stepLimitOf(gale));
    EXPECT_LT(stepLimitOf(gale), stepLimitOf(hanging()));
}

TEST(Envelope, ASpawnedBodyIsAllowedForLikeAnother) {
    SceneSpec scene = hanging();
    auto grab = support::grab(0.5, "cloth.sheet@bottom-right");
    grab.strength = 3000;
    scene.actions = {grab};
    const double limit = stepLimitOf(scene);
    scene.actions = {action<SpawnAction>(0.1, "cloth.sheet"), grab};
    World world(scene);
    for (int i = 0; i < 7; ++i) ASSERT_FALSE(world.advance());
    EXPECT_EQ(world.islands()[0].stepLimit, limit);
}

// The point of it all: a hand so strong that the step of the cloth alone would not bear it.
TEST(Envelope, TheStepBearsAHandThatItWouldNotBearWithoutAllowingForIt) {
    SceneSpec scene = hanging();
    scene.solver.onDivergence = OnDivergence::stop;
    auto grab = support::grab(0.1, "cloth.sheet@bottom-right");
    grab.strength = 5000;
    const auto survives = [&](World& world) {
        for (int tick = 0; tick < 120; ++tick) {
            if (tick == 6) world.apply(grab);
            if (world.advance()) return false;
        }
        return true;
    };
    World unaware(scene, {.keepsSteps = true});
    EXPECT_FALSE(survives(unaware));
    ASSERT_FALSE(unaware.warnings().empty());
    EXPECT_NE(unaware.warnings().back().text.find("its step of"), std::string::npos) << unaware.warnings().back().text;
    World following(scene);
    EXPECT_TRUE(survives(following));
    EXPECT_TRUE(following.warnings().empty()) << following.warnings().front().text;
    scene.hand = {true, 5000, 0.3};
    World aware(scene, {.keepsSteps = true});
    EXPECT_TRUE(survives(aware));
    EXPECT_TRUE(aware.warnings().empty()) << aware.warnings().front().text;
    const IslandInfo island = aware.islands()[0];
    EXPECT_LE(island.step, 0.9 * island.stepLimit);
}

TEST(Envelope, TheStepStaysThroughEverything) {
    const SceneSpec scene = support::everythingHappens();
    World world(scene, {.keepsSteps = true});
    std::vector<double> steps;
    for (const IslandInfo& island : world.islands()) {
        steps.push_back(island.step);
        EXPECT_LE(island.step, 0.9 * island.stepLimit * (1 + 1e-12));
    }
    for (int i = 0; i < 30; ++i) ASSERT_FALSE(world.advance());
    for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(world.islands()[i].step, steps[i]);
    for (const std::string& warning : printed(world.warnings())) ADD_FAILURE() << warning;
}

}  // namespace
}  // namespace taut::world
