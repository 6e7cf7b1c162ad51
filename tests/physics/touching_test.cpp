// Cloths, ropes and blocks that touch each other and themselves, through the world.
#include "touching_scenes.h"

#include "support/knots.h"

namespace taut::test::touching {
namespace {

using world::World;

constexpr double pi = 3.14159265358979323846;

// How far a small sheet goes down on a large one that is held, in half a second. The slope is made by gravity.
double slide(double degrees, double friction) {
    world::SceneSpec spec = scene(friction);
    const double angle = degrees * pi / 180.0;
    spec.world.gravity = g * dvec3(std::sin(angle), -std::cos(angle), 0.0);
    world::ClothSpec slope = sheet("slope", {-0.15, 0.0, -0.15}, {0.6, 0, 0}, {0, 0, 0.3}, 12);
    slope.hold = {"all"};
    spec.bodies.add(slope);
    spec.bodies.add(sheet("upper", {-0.061, keep, -0.063}, {0.12, 0, 0}, {0, 0, 0.12}, 4));
    World world(spec);
    const double before = meanAlong(positionsOf(world, "cloth.upper"), {1, 0, 0});
    EXPECT_FALSE(advance(world, 30));
    return meanAlong(positionsOf(world, "cloth.upper"), {1, 0, 0}) - before;
}

// Coulomb: it stays up to tan α = μ, 21.80° for 0.4, and has a = g (sin α - μ cos α) beyond.
TEST(TouchingSlope, HoldsAClothUpToItsAngle) {
    EXPECT_LT(std::abs(slide(21.0, 0.4)), 1e-5);
}
TEST(TouchingSlope, LetsAClothSlideAsCoulombSays) {
    for (const double degrees : {22.5, 30.0}) {
        const double angle = degrees * pi / 180.0, a = g * (std::sin(angle) - 0.4 * std::cos(angle));
        EXPECT_NEAR(slide(degrees, 0.4) / (0.5 * a * 0.25), 1.0, 0.01) << degrees;
    }
}
TEST(TouchingSlope, TellsTwiceTheFriction) {
    EXPECT_LT(std::abs(slide(30.0, 0.8)), 1e-5);  // it would be 0.19 m with 0.4
}

// On a plane that slopes by 20°, tan 20° = 0.36 < 0.5: the upper sheets press the lowest to the ground as well as it
// draws it down, so that a pile stays where one sheet does.
TEST(TouchingSlope, HoldsAPileAsItHoldsOneSheet) {
    for (const int sheets : {1, 2, 3}) {
        world::SceneSpec spec = scene(0.8);
        const double angle = 20.0 * pi / 180.0;
        spec.world.gravity = g * dvec3(std::sin(angle), -std::cos(angle), 0.0);
        spec.colliders = {ground(0.0, 0.5)};
        for (int k = 0; k < sheets; ++k)
            spec.bodies.add(
                sheet("sheet" + std::to_string(k), {-0.1, keep * (k + 0.5), -0.1}, {0.2, 0, 0}, {0, 0, 0.2}, 4));
        World world(spec);
        EXPECT_FALSE(advance(world, 30));  // in which they stretch by their new load
        const double before = meanAlong(positionsOf(world, "cloth.sheet0"), {1, 0, 0});
        EXPECT_FALSE(advance(world, 30));
        EXPECT_LT(std::abs(meanAlong(positionsOf(world, "cloth.sheet0"), {1, 0, 0}) - before), 1e-5) << sheets;
    }
}

// A point over 40 cells of 2 cm, pressed down by its weight: the edges that it passes are no obstacles.
TEST(TouchingSlide, LosesNothingOnAFlatClothWithoutFriction) {
    world::SceneSpec spec = scene(0.0);
    world::ClothSpec track = sheet("track", {-0.1, 0.0, -0.05}, {1.0, 0, 0}, {0, 0, 0.1}, 50);
    track.hold = {"all"};
    spec.bodies.add(track);
    world::NetSpec net;
    net.name = "ball";
    net.drag = 0.0;
    net.thickness = keep / 2;
    net.velocity = {5.0, 0.0, 0.3};
    net.touch = world::Touch::all;
    net.points = {{"only", {0.0031, keep, -0.0217}, 0.01, false, {}}};
    spec.bodies.add(net);
    World world(spec);
    for (int i = 0; i < 10; ++i) {
        ASSERT_FALSE(world.advance());
        EXPECT_NEAR(positionsOf(world, "net.ball")[0].y, keep, 0.05 * keep);
    }
    EXPECT_GT(positionsOf(world, "net.ball")[0].x, 0.8);
    EXPECT_GT(world.metrics("net.ball").momentum.x, 0.99 * 0.05);
    EXPECT_LT(world.metrics("net.ball").momentum.x, 1.001 * 0.05);
}

// At any speed: pairs are detected no more often than there are steps.
TEST(TouchingSlide, OfStiffOnWhatIsHeldNeedsNoMoreDetectionsThanThereAreSteps) {
    world::SceneSpec spec = scene(0.0);
    world::ClothSpec track = sheet("track", {-0.1, 0.0, -0.05}, {1.0, 0, 0}, {0, 0, 0.1}, 50);
    track.hold = {"all"};
    spec.bodies.add(track);
    world::ClothSpec patch = sheet("patch", {-0.0231, keep, -0.0217}, {0.03, 0, 0.01}, {-0.01, 0, 0.03}, 2);
    patch.velocity = {5.0, 0.0, 0.0};
    spec.bodies.add(patch);
    World world(spec);
    for (int i = 0; i < 10; ++i) {
        ASSERT_FALSE(world.advance());
        for (const world::IslandInfo& island : world.islands())
            EXPECT_LE(world.contact().lastDetections, island.substeps) << i;
    }
}

// Two sheets that fall flat on the ground: each keeps its distance, and they come to rest.
TEST(TouchingStack, OfTwoSheetsKeepsItsDistanceAndComesToRest) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    spec.bodies.add(sheet("lower", {0.0, 0.01, 0.0}, {0.3, 0, 0}, {0, 0, 0.3}, 6));
    spec.bodies.add(sheet("upper", {0.013, 0.03, 0.017}, {0.28, 0, 0.02}, {-0.02, 0, 0.28}, 6));
    World world(spec);
    EXPECT_FALSE(advance(world, 90));
    EXPECT_LT(fastest(world, {"cloth.lower", "cloth.upper"}), 1e-3);  // a step's fall gives 0.01 m/s
    for (const dvec3& x : positionsOf(world, "cloth.lower")) EXPECT_NEAR(x.y, keep / 2, 0.05 * keep);
    for (const dvec3& x : positionsOf(world, "cloth.upper")) EXPECT_NEAR(x.y, 1.5 * keep, 0.05 * keep);
}

TEST(TouchingStack, OfTwoBlocksComesToRest) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    for (int k = 0; k < 2; ++k) {
        world::BlockSpec block;
        block.name = k == 0 ? "lower" : "upper";
        block.size = dvec3(k == 0 ? 0.3 : 0.2);
        block.cells = {3, 3, 3};
        block.position = {0.0, k == 0 ? 0.16 : 0.44, 0.0};
        block.dampingTime = 5e-3;
        block.thickness = keep / 2;
        block.touch = world::Touch::all;
        spec.bodies.add(block);
    }
    World world(spec);
    EXPECT_FALSE(advance(world, 20));
    const double early = fastest(world, {"block.lower", "block.upper"});
    EXPECT_FALSE(advance(world, 160));
    EXPECT_LT(fastest(world, {"block.lower", "block.upper"}), 0.05 * early);
    // The upper stands on the middle of the lower's top.
    double top = 0, bottom = 1e300;
    for (const dvec3& x : positionsOf(world, "block.lower"))
        if (std::abs(x.x) < 0.1 && std::abs(x.z) < 0.1) top = std::max(top, x.y);
    for (const dvec3& x : positionsOf(world, "block.upper")) bottom = std::min(bottom, x.y);
    EXPECT_NEAR(bottom - top, keep, 0.05 * keep);
}

world::SceneSpec foldingScene(int cells) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    world::ClothSpec cloth = sheet("flag", {0.0, 1.01, 0.0}, {1.0, 0, 0}, {0, -1.0, 0}, cells);
    cloth.jitter = 0.1 / cells;
    spec.bodies.add(cloth);
    spec.materials["linen"].drag = 0.5;
    return spec;
}

// A cloth falls on its edge, and is lifted by the other: no crossing on the way, and nothing stays stuck. A cloth that
// does not touch itself says how long it would hang in the mean of its swings, and how much it crosses itself without.
TEST(TouchingFold, FallsLiftsAndHangsAsIfItHadNot) {
    constexpr int cells = 14;
    std::array<double, 2> lengths{};
    for (const bool touches : {true, false}) {
        world::SceneSpec spec = foldingScene(cells);
        spec.contact.friction = 0.0;  // which may hold a fold for good
        if (!touches) spec.bodies.of<world::ClothSpec>()[0].touch = world::Touch::nothing;
        world::GrabAction grab;
        grab.t = 1.0;
        grab.target = "cloth.flag@top";
        grab.id = "hand";
        grab.rigid = true;
        world::MoveAction lift;
        lift.t = 1.0;
        lift.id = "hand";
        lift.to = dvec3(0.5, 1.6, 0.0);
        lift.over = 1.0;
        spec.actions = {grab, lift};
        World world(spec);
        const PiercingWitness witness(spec, {"cloth.flag"});
        int crossings = 0;
        constexpr int ticks = 60 * 6, swinging = 60 * 3;
        for (int i = 0; i < ticks; ++i) {
            ASSERT_FALSE(world.advance());
            crossings = std::max(crossings, witness.count(world));
            if (i < ticks - swinging) continue;
            const std::vector<dvec3> x = positionsOf(world, "cloth.flag");
            lengths[touches ? 0 : 1] += (meanAlong({x.begin(), x.begin() + cells + 1}, {0, 1, 0}) -
                                         meanAlong({x.end() - cells - 1, x.end()}, {0, 1, 0})) /
                                        swinging;
        }
        EXPECT_EQ(crossings > 0, !touches) << crossings;
    }
    EXPECT_NEAR(lengths[0] / lengths[1], 1.0, 0.02);
}

// Through each other as they are made: led apart, out of each other's middle as well, where the line of intersection
// goes from border to border and gets no shorter at first; of the last, until it is gone. Repulsion alone would hold
// them for ever.
TEST(TouchingUntangling, LeadsSheetsApartThatWereBornCrossed) {
    const std::array seconds{
        sheet("second", {0.01, 0.31, 0.01}, {0.28, -0.28, 0.03}, {-0.28, -0.28, 0.02}, 7),
        sheet("second", {-0.2, 0.21, 0.01}, {0.4, 0, 0.03}, {0.01, -0.4, 0.02}, 7),
        sheet("second", {-0.2, -0.05, -0.17}, {0.4, 0.1, 0.03}, {0.01, 0.04, 0.4}, 7),
        sheet("second", {-0.2, -0.16, 0.01}, {0.4, 0, 0}, {0, 0.38, 0.12}, 7),
    };
    for (const world::ClothSpec& second : seconds) {
        world::SceneSpec spec = scene();
        spec.world.gravity = dvec3(0.0);
        spec.bodies.add(sheet("first", {-0.3, 0.0, -0.3}, {0.6, 0, 0}, {0, 0, 0.6}, 10));
        spec.bodies.add(second);
        World world(spec);
        const PiercingWitness witness(spec, {"cloth.first", "cloth.second"});
        EXPECT_GT(witness.count(world), 20);
        int left = -1;
        double strain = 0;
        for (int i = 0; i < 120 && left != 0; ++i) {
            ASSERT_FALSE(world.advance());
            left = witness.count(world);
            strain = std::max(strain, world.metrics().maxStrain);
        }
        EXPECT_EQ(left, 0);
        EXPECT_LT(strain, 0.1);
        EXPECT_FALSE(advance(world, 30));
        EXPECT_EQ(witness.count(world), 0);
    }
}

// One that lies on a ball, and one with a corner through it.
TEST(TouchingUntangling, TakesACornerOutOfASheetOnABall) {
    world::SceneSpec spec = scene();
    world::ColliderSpec ball;
    ball.name = "ball";
    ball.radius = 0.15;
    spec.colliders = {ball};
    spec.bodies.add(sheet("lower", {-0.2, 0.156, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 10));
    spec.bodies.add(sheet("upper", {-0.05, 0.146, -0.1}, {0.25, 0.1, 0.0}, {0, 0.03, 0.25}, 6));
    World world(spec);
    const PiercingWitness witness(spec, {"cloth.lower", "cloth.upper"});
    EXPECT_GT(witness.count(world), 3);
    int left = -1;
    for (int i = 0; i < 60; ++i) {
        ASSERT_FALSE(world.advance());
        left = witness.count(world);
        if (left == 0) break;
    }
    EXPECT_EQ(left, 0);
}

}  // namespace
}  // namespace taut::test::touching
