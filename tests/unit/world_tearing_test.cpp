// Tearing and yielding: independence of cells and steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/timelines.h"
#include "taut/advice/rehearsal.h"
#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/world/world.h"

namespace taut::world::tearing {
namespace {

using support::run;

// A sheet of 1.2 m, held along its top, with a weight along its bottom that grows by 10 N/s.
struct Pulled {
    int cells = 12;
    double notch = 0.2;  // [m]
    double fps = 60;
    double safety = 0.9;
    // [N] at which it begins to tear, to half the growth of a tick; it has to be in two a second later.
    double load() const {
        SceneSpec scene;
        scene.run.fps = fps;
        scene.solver.safety = safety;
        scene.world.gravity = dvec3(0.0);
        MaterialSpec& paper = scene.materials["paper"];
        paper.density = 0.15;
        paper.stretch = 600;
        paper.drag = 20;
        paper.dampingTime = 2e-3;
        paper.plasticity.breakStrain = 0.08;
        ClothSpec sheet = support::cloth("sheet", cells);
        sheet.size = {1.2, 1.2};
        sheet.material = "paper";
        sheet.hold = {"top"};
        scene.bodies.add(sheet);
        scene.masses = {{"cloth.sheet@bottom", 1.0, {}}};
        const auto gravity = [](SceneSpec& s) -> double& { return s.world.gravity.y; };
        scene.actions = {
            support::ramp(0.0, "world.gravity", fields::Affects::forces, -100.0, 10.0, Ease::linear, gravity)};
        if (notch > 0) scene.actions.add(support::cutSegment(0.0, "cloth.sheet", {0.0, 0.51}, {notch / 1.2, 0.51}));
        World world(scene);
        run(world, 1);
        const int cut = world.metrics().brokenSprings;
        while (world.metrics().brokenSprings == cut && world.time() < 10) run(world, 1);
        const double at = 10 * (world.time() - 0.5 / fps);
        run(world, static_cast<int>(fps));
        EXPECT_GE(world.metrics().brokenSprings, 3 * cells + 1) << "it has not torn through";
        return at;
    }
};

// The notch is 1, 2 and 4 cells long.
TEST(Tearing, TheLoadAtWhichANotchRunsHardlyDependsOnTheCells) {
    const double coarse = Pulled{.cells = 6}.load(), middle = Pulled{.cells = 12}.load(),
                 fine = Pulled{.cells = 24}.load();
    // The notch of broken springs is longer than it by up to half a cell: 25 % are promised.
    EXPECT_LT(std::max({coarse, middle, fine}), 1.25 * std::min({coarse, middle, fine}));
    // And it is the notch that makes it tear: without, at the strain to break.
    const double whole = Pulled{.cells = 12, .notch = 0}.load();
    EXPECT_GT(whole, 2 * middle);
}

TEST(Tearing, TheLoadDependsNeitherOnTheTicksNorOnTheStep) {
    const double load = Pulled{}.load();
    // A tick is 1/6 N at 60 a second.
    EXPECT_NEAR((Pulled{.fps = 240}.load()), load, 1.0 / 6);
    EXPECT_NEAR((Pulled{.safety = 0.3}.load()), load, 1.0 / 6);
}

// Points along the edges of a tear are not at its tip.
TEST(Tearing, ASheetCutAlongItsLoadBearsWhatItBore) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = Precision::double_;
    scene.materials["paper"].drag = 20;
    scene.materials["paper"].plasticity.breakStrain = 0.1;
    ClothSpec sheet = support::cloth("sheet", 6);  // of 1/6 m: at a tip it breaks at 0.045
    sheet.material = "paper";
    sheet.hold = {"top"};
    scene.bodies.add(sheet);
    scene.actions = {support::cutSegment(0.0, "cloth.sheet", {0.55, 0.2}, {0.55, 1.0}),
                     support::grab(0.0, "cloth.sheet@bottom", true)};
    scene.actions.add(support::moveHand(0.0, {0.5, 0.925, 0.0}, 2.0));
    World world(scene);
    run(world, 1);
    const int cut = world.metrics().brokenSprings;
    run(world, 180);
    EXPECT_NEAR(world.metrics().maxStrain, 0.075, 0.02);
    EXPECT_EQ(world.metrics().brokenSprings, cut);
}

TEST(Tearing, ByMethodsWithoutALimitIsWarnedOfUnlessTheirStepIsGiven) {
    SceneSpec scene;
    scene.materials["paper"].plasticity.breakStrain = 0.1;
    ClothSpec sheet = support::cloth("sheet", 2);
    sheet.material = "paper";
    scene.bodies.add(sheet);
    const auto isWarned = [&] {
        const std::vector<std::string> all = printed(World(scene).warnings());
        return std::any_of(all.begin(), all.end(), [](const std::string& warning) {
            return warning.find("cloth.sheet: tears and yield") != std::string::npos;
        });
    };
    EXPECT_FALSE(isWarned());
    scene.solver.integrator = "sdirk2";
    EXPECT_TRUE(isWarned());
    scene.solver.dt = 1e-3;
    EXPECT_FALSE(isWarned());
}

// A spring torn, one that yields at once, and an impact, in a tick that another body's end undoes.
TEST(Tearing, AnUndoneTickTakesBackWhatToreAndGaveWay) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.onDivergence = OnDivergence::stop;
    const auto pair = [](const char* name, double z, double length, dvec3 velocity) {
        NetSpec net;
        net.name = name;
        net.points = {{"a", {0, 1, z}, 10.0, false, {}}, {"b", {1, 1, z}, 10.0, false, {}}};
        net.springs = {{"a", "b", 100.0, length, std::nullopt, {}}};
        net.velocity = velocity;
        return net;
    };
    NetSpec tears = pair("tears", 0, 0.8, {}), yields = pair("yields", 1, 0.8, {});
    tears.plasticity.breakStrain = 0.2;
    yields.plasticity.yieldStrain = 0.2;
    scene.bodies.add(tears);
    scene.bodies.add(yields);
    NetSpec lands = pair("lands", 3, 1.0, {0, -5, 0});  // within a tick, from 0.05 m
    for (auto& point : lands.points) point.position.y = 0.05 + lands.thickness;
    scene.bodies.add(lands);
    ColliderSpec ground;
    ground.name = "ground";
    ground.shape = "plane";
    scene.colliders = {ground};
    World alone(scene);
    run(alone, 1);
    EXPECT_EQ(alone.metrics("net.lands").contacts, 2);
    EXPECT_EQ(alone.metrics("net.tears").brokenSprings, 1);
    EXPECT_NEAR(alone.metrics("net.yields").maxStrain, 0.2, 1e-3);
    // As fast as allowed; its spring makes one of its ends faster still.
    NetSpec flies = pair("flies", 2, 1e-3, {mechanics::speedLimit, 0, 0});
    flies.springs[0].stiffness = 1e6;
    scene.bodies.add(flies);
    World world(scene);
    ASSERT_TRUE(world.advance());
    EXPECT_EQ(world.metrics("net.tears").brokenSprings, 0);
    EXPECT_NEAR(world.metrics("net.yields").maxStrain, 0.25, 1e-6);
    EXPECT_NEAR(world.metrics("net.tears").elastic, 0.5 * 100 * 0.2 * 0.2, 1e-5);
    EXPECT_EQ(world.metrics("net.lands").contacts, 0);
    EXPECT_NEAR(world.metrics("net.lands").kinetic, 0.5 * 20 * 25, 1e-3);  // drag of a tick that did not count
}

// A block pulled so hard that a tick diverges and is repeated in shorter steps: tears of the discarded tick are undone.
TEST(Tearing, ARepeatedTickKnowsNothingOfTheOneBefore) {
    SceneSpec scene;
    scene.bodies.add(support::stiffBlock("b"));
    scene.actions = {support::push(0.1, "block.b@top", {0, 200, 0})};  // N s
    World whole(scene);
    double strain = 0;
    for (int i = 0; i < 30; ++i) {
        run(whole, 1);
        strain = std::max(strain, whole.metrics().maxStrain);
    }
    const std::vector<StepChange> changes = whole.islands()[0].stepChanges;
    ASSERT_TRUE(std::any_of(changes.begin(), changes.end(), [](const StepChange& c) { return c.isRepeated; }));
    scene.bodies.of<BlockSpec>()[0].plasticity.breakStrain = 3 * strain;
    World world(scene);
    run(world, 30);
    EXPECT_EQ(world.metrics().brokenSprings, 0);
    EXPECT_EQ(world.stateHash(), whole.stateHash());
}

// The bar of `Yielding` bent slowly: the rest of the bend hardly depends on the number of ticks.
TEST(Yielding, LastingStrainDoesNotDependOnTheTicks) {
    const auto offset = [](double fps) {
        SceneSpec scene;
        scene.run.fps = fps;
        scene.world.gravity = dvec3(0.0);
        BlockSpec bar;
        bar.name = "bar";
        bar.size = {0.8, 0.1, 0.1};
        bar.cells = {8, 1, 1};
        bar.hold = {"left"};
        bar.drag = 6;
        bar.dampingTime = 2e-3;
        bar.plasticity.yieldStrain = 0.01;
        scene.bodies.add(bar);
        scene.actions = {support::grab(0.0, "block.bar@right", true), support::moveHand(0.0, {0.36, -0.2, 0}, 0.5),
                         support::release(0.6)};
        World world(scene);
        run(world, static_cast<int>(4 * fps));
        double y = 0;
        for (const dvec3& x : world.points("block.bar@right").x) y += x.y / 4;
        return y;
    };
    const double slow = offset(60);
    EXPECT_LT(slow, -0.08);
    EXPECT_NEAR(offset(240), slow, 0.005 * std::abs(slow));
}

TEST(Rehearsal, SaysThatTearingAtASinglePointDependsOnTheCells) {
    SceneSpec scene;
    scene.run.seconds = 1;
    scene.materials["paper"].plasticity.breakStrain = 0.1;
    ClothSpec sheet = support::cloth("sheet", 4);
    sheet.material = "paper";
    sheet.hold = {"top"};
    scene.bodies.add(sheet);
    const auto warnings = [&] { return printed(rehearse(scene).warnings); };
    EXPECT_TRUE(warnings().empty());
    scene.actions = {support::grab(0.5, "cloth.sheet@bottom-left")};
    ASSERT_EQ(warnings().size(), 1U);
    EXPECT_TRUE(warnings()[0].starts_with("cloth.sheet is held or loaded at a single point, #20: "));
    auto wide = support::grab(0.5, "cloth.sheet@bottom-left");
    wide.radius = 0.3;
    scene.actions = {wide};
    EXPECT_TRUE(warnings().empty());
    scene.actions = {};
    scene.bodies.of<ClothSpec>()[0].hold = {"corners"};
    EXPECT_EQ(warnings().size(), 1U);
    scene.materials["paper"].plasticity = {};
    EXPECT_TRUE(warnings().empty());
}

}  // namespace
}  // namespace taut::world::tearing
