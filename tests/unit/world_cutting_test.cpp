// Cuts, tears and yielding: severed springs, drawn surfaces, and remaining parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/timelines.h"
#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/bodies/rope.h"
#include "taut/bodies/solid.h"
#include "taut/forces/wind.h"
#include "taut/spec/private/rotation.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

using support::run;

using support::g;

SceneSpec sheet(int cells = 6) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.materials["linen"] = MaterialSpec{};
    scene.materials["linen"].drag = 0;
    scene.bodies.add(support::cloth("sheet", cells));
    scene.bodies.of<ClothSpec>()[0].material = "linen";
    return scene;
}

double area(const view::Surface& surface) {
    double sum = 0;
    const auto& x = surface.geometry->positions;
    const auto& t = surface.topology->triangles;
    for (std::size_t i = 0; i < t.size(); i += 3)
        sum += 0.5 * static_cast<double>(glm::length(glm::cross(x[t[i + 1]] - x[t[i]], x[t[i + 2]] - x[t[i]])));
    return sum;
}

// The halves of a cloth that flies apart along the cut know nothing of each other any more.
TEST(Cutting, NoForceCrossesACut) {
    SceneSpec scene = sheet();
    scene.world.gravity = dvec3(0.0);
    scene.actions = {support::cutPlane(0.0, "cloth.sheet", {0.55, 0, 0}, {1, 0, 0}),
                     support::push(0.0, "cloth.sheet@left", {-0.02, 0, 0.03}),
                     support::push(0.0, "cloth.sheet@right", {0.05, 0.01, 0})};
    World world(scene);
    run(world, 120);
    const PointsNow now = world.points("cloth.sheet");
    dvec3 left(0.0), right(0.0);
    for (std::size_t i = 0; i < now.x.size(); ++i) (i % 7 < 4 ? left : right) += now.mass[i] * now.v[i];
    EXPECT_NEAR(glm::length(left - dvec3(-0.02, 0, 0.03)), 0, 1e-12);
    EXPECT_NEAR(glm::length(right - dvec3(0.05, 0.01, 0)), 0, 1e-12);
}

// Held at the top and cut across: the lower part falls freely, the upper part stays held.
TEST(Cutting, CutPartsFallFreely) {
    SceneSpec scene = sheet();
    scene.bodies.of<ClothSpec>()[0].hold = {"top"};
    scene.actions = {support::cutPlane(0.0, "cloth.sheet", {0, 1.45, 0}, {0, 1, 0})};
    World world(scene);
    run(world, 30);
    const PointsNow now = world.points("cloth.sheet");
    for (std::size_t i = 28; i < 49; ++i) EXPECT_NEAR(now.v[i].y, -g * 0.5, 1e-9) << i;
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(now.v[i], dvec3(0.0));
    // Row by row: 7 structural, 12 shear; two rows of 7 bend springs lie across.
    EXPECT_EQ(world.metrics().brokenSprings, 7 + 12 + 14);
}

TEST(Cutting, ASegmentCutsOnlyWhereItGoes) {
    SceneSpec scene = sheet();
    scene.actions = {support::cutSegment(0.0, "cloth.sheet", {-0.1, 0.45}, {0.4, 0.45})};
    World world(scene);
    run(world, 1);
    // Columns 0, 1 and 2 lie at 0, 1/6 and 2/6, and the segment ends in the third cell, before its diagonals cross it
    // (at 0.45 they do so 0.3 and 0.7 of a cell on).
    EXPECT_EQ(world.metrics().brokenSprings, 3 + 5 + 6);
}

TEST(Cutting, ACutIsDrawnUpToItsEdgeOnBothSides) {
    SceneSpec scene = sheet();
    scene.world.gravity = dvec3(0.0);
    scene.actions = {support::cutPlane(0.1, "cloth.sheet", {0.55, 0, 0}, {1, 0.2, 0})};
    World world(scene);
    run(world, 6);
    EXPECT_NEAR(area(world.view(false).surfaces[0]), 1.0, 1e-5);
    run(world, 6);
    const view::FrameView view = world.view(false);
    const view::Surface& cut = view.surfaces[0];
    EXPECT_NEAR(area(cut), 1.0, 1e-5);  // at rest the halves meet: nothing is missing, nothing is twice
    // No triangle lies on both sides.
    const auto side = [&](std::uint32_t v) {
        const glm::vec3 x = cut.geometry->positions[v];
        return static_cast<double>(x.x) - 0.55 + 0.2 * static_cast<double>(x.y);
    };
    for (std::size_t i = 0; i < cut.topology->triangles.size(); i += 3) {
        double low = 1, high = -1;
        for (std::size_t k = 0; k < 3; ++k) {
            low = std::min(low, side(cut.topology->triangles[i + k]));
            high = std::max(high, side(cut.topology->triangles[i + k]));
        }
        EXPECT_TRUE(low > -1e-5 || high < 1e-5) << i << ' ' << low << ' ' << high;
    }
}

TEST(Cutting, ACutThroughAllOfAClothStopsTheWindWhereItGoes) {
    SceneSpec scene = sheet(2);
    scene.world.gravity = dvec3(0.0);
    WindSpec wind;
    wind.name = "breeze";
    wind.velocity = {0, 0, 0.05};  // so gentle that within a tick the cloth does not give way to it
    scene.forces.add(wind);
    World whole(scene);
    scene.actions = {support::cutPlane(0.0, "cloth.sheet", {0.25, 0, 0}, {1, 0, 0})};
    World cut(scene);
    run(whole, 1);
    run(cut, 1);
    // One of the two columns of cells is gone, so half of the force.
    EXPECT_NEAR(cut.metrics().momentum.z / whole.metrics().momentum.z, 0.5, 1e-3);
}

TEST(Cutting, ACutRopeIsTwoRopes) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.bodies.add(support::rope("line", {0, 3, 0}, {0, 2, 0}, 10));
    scene.bodies.of<RopeSpec>()[0].hold = {"start"};
    scene.bodies.of<RopeSpec>()[0].drag = 0;
    scene.bodies.of<RopeSpec>()[0].bend = 10;
    scene.actions = {support::cutPlane(0.2, "rope.line", {0, 2.55, 0}, {0, 1, 0})};
    World world(scene);
    run(world, 12);
    EXPECT_EQ(world.view(false).surfaces.size(), 1U);
    const double v = world.points("rope.line@end").v[0].y;
    run(world, 30);
    EXPECT_EQ(world.view(false).surfaces.size(), 2U);
    EXPECT_EQ(world.metrics().brokenSprings, 1 + 2);
    const PointsNow now = world.points("rope.line");
    double momentum = 0, mass = 0;
    for (std::size_t i = 5; i < 11; ++i) {
        momentum += now.mass[i] * now.v[i].y;
        mass += now.mass[i];
    }
    EXPECT_NEAR(momentum / mass, v - g * 0.5, 2e-2);  // v of the end alone shows its own swinging
    EXPECT_LT(std::abs(now.v[0].y), 1e-12);
}

// Six tetrahedra a cell; a plane through the middle of a layer of cells crosses all of them.
TEST(Cutting, ABlockLosesTheCellsThatAreCrossedAndGetsASurfaceThere) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = Precision::double_;
    BlockSpec brick;
    brick.name = "brick";
    brick.size = {0.6, 0.2, 0.2};
    brick.cells = {3, 1, 1};
    scene.bodies.add(brick);
    scene.actions = {support::cutPlane(0.1, "block.brick", {0.03, 0, 0}, {1, 0, 0})};
    World world(scene);
    run(world, 6);
    EXPECT_NEAR(area(world.view(false).surfaces[0]), 4 * 0.6 * 0.2 + 2 * 0.04, 1e-6);
    EXPECT_NEAR(world.metrics().volume, 0.024, 1e-9);
    run(world, 6);
    EXPECT_NEAR(world.metrics().volume, 0.016, 1e-9);
    // Both halves are drawn up to the cut, closed there.
    EXPECT_NEAR(area(world.view(false).surfaces[0]), 4 * 0.6 * 0.2 + 4 * 0.04, 1e-5);
}

// Of a turned block two cuts leave a row of points, by which nothing can be carried: it is drawn as that.
TEST(Cutting, ARowOfPointsIsLeft) {
    SceneSpec scene;
    BlockSpec brick;
    brick.name = "brick";
    brick.size = dvec3(0.4);
    brick.cells = {4, 4, 4};
    brick.rotation = {0.47, 0.51, 0.5};
    scene.bodies.add(brick);
    const glm::dquat turn = rotationOf(brick.rotation);
    for (const dvec3& normal : {rotated(turn, {1, 0, 0}), rotated(turn, {0, 1, 0})})
        scene.actions.add(support::cutPlane(0.1, "block.brick", 0.16 * normal, normal));
    World world(scene);
    run(world, 12);
    const view::FrameView view = world.view(false);
    for (const glm::vec3& x : view.surfaces[0].geometry->positions) EXPECT_LT(glm::length(x), 2.0F);
}

// A rope of EA = 100 N pulled by a hand: it tears once (l - L)/L is over the break strain, and nowhere else before.
// A cut through a rigid body removes nothing, and is reported.
TEST(Cutting, RigidBodiesStayComplete) {
    SceneSpec scene;
    SolidSpec crate;
    crate.name = "crate";
    crate.position = {0.0, 0.3, 0.0};
    scene.bodies.add(crate);
    ColliderSpec& post = scene.colliders.emplace_back();
    post.name = "post";
    post.shape = "box";
    post.size = {0.05, 0.2, 0.05};
    post.position = {0.0, -0.06, 0.0};
    scene.actions = {support::cutPlane(0.0, "solid.crate", {0, 0, 0}, {1, 0, 0})};
    World world(scene);
    run(world, 30);
    EXPECT_FALSE(world.warnings().empty());
    EXPECT_GT(world.points("solid.crate").x[0].y, 0.2);
}

TEST(Tearing, ComesAtTheStatedStrain) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = Precision::double_;
    scene.bodies.add(support::rope("line", {0, 0, 0}, {1, 0, 0}, 4));
    scene.bodies.of<RopeSpec>()[0].hold = {"start"};
    scene.bodies.of<RopeSpec>()[0].stretch = 100;
    scene.bodies.of<RopeSpec>()[0].mass = 0.01;  // waves run through it in 1/100 s, so that it is strained evenly
    scene.bodies.of<RopeSpec>()[0].drag = 50;
    scene.bodies.of<RopeSpec>()[0].plasticity.breakStrain = 0.25;
    scene.actions = {support::grab(0.0, "rope.line@end", true), support::moveHand(0.0, {2, 0, 0}, 4.0, Ease::linear)};
    World world(scene);
    double last = 0;
    int ticks = 0;
    while (world.metrics().brokenSprings == 0 && ticks++ < 240) {
        if (const auto hand = world.handPlace("hand")) last = hand->x - 1;  // there is none before the first tick
        run(world, 1);
    }
    EXPECT_NEAR(last, 0.25, 0.01);  // asked once a tick, in which the strain grows by 0.004
    run(world, 1);                  // strained evenly, more than one may tear before all are relieved
    const int broken = world.metrics().brokenSprings;
    run(world, 60);
    EXPECT_EQ(world.metrics().brokenSprings, broken);  // the parts are slack
    EXPECT_LT(world.metrics().maxStrain, 0.02);
}

TEST(Tearing, AClothTearsOnWhereACutHasBegun) {
    SceneSpec scene = sheet(12);
    MaterialSpec& linen = scene.materials["linen"];
    linen.stretch = 60;
    linen.drag = 1;
    linen.dampingTime = 2e-3;
    linen.plasticity.breakStrain = 0.12;
    scene.bodies.of<ClothSpec>()[0].hold = {"top"};
    scene.masses = {{"cloth.sheet@bottom", 0.15, {}}};
    const auto brokenAfter = [](const SceneSpec& s) {
        World world(s);
        run(world, 90);
        return world.metrics().brokenSprings;
    };
    EXPECT_EQ(brokenAfter(scene), 0);
    scene.actions = {support::cutSegment(0.0, "cloth.sheet", {-0.1, 0.46}, {0.4, 0.46})};
    World world(scene);
    run(world, 1);
    const int cut = world.metrics().brokenSprings;
    run(world, 89);
    EXPECT_GT(world.metrics().brokenSprings, cut + 10);
}

// A bar clamped at one end, its other end led aside and back and released: below yield it returns, above it stays bent.
double offsetAfterBending(std::optional<double> yieldStrain) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = Precision::double_;
    BlockSpec bar;
    bar.name = "bar";
    bar.size = {0.8, 0.1, 0.1};
    bar.cells = {8, 1, 1};
    bar.hold = {"left"};
    bar.young = 1e5;  // comes back at ω²/drag: thin bars bend easily
    bar.drag = 6;
    bar.dampingTime = 2e-3;
    bar.plasticity.yieldStrain = yieldStrain;
    scene.bodies.add(bar);
    scene.actions = {support::grab(0.0, "block.bar@right", true), support::moveHand(0.0, {0.36, -0.2, 0}, 0.5),
                     support::release(0.6)};
    World world(scene);
    run(world, 360);
    double y = 0;
    for (const dvec3& x : world.points("block.bar@right").x) y += x.y / 4;
    return y;
}

TEST(Yielding, ABarBentPastYieldStaysBentAndOneBelowComesBack) {
    const double elastic = offsetAfterBending(std::nullopt);
    EXPECT_NEAR(elastic, 0, 1e-3);
    EXPECT_NEAR(offsetAfterBending(0.5), elastic, 1e-12);  // no spring comes near a half
    const double bent = offsetAfterBending(0.01);
    EXPECT_LT(bent, -0.08);
    EXPECT_GT(bent, -0.2);  // some of it was elastic
}

// A spring pulled to 1.5 L with yield at 0.1 is left with L' = 1.5 L / 1.1; the largest strain told is the yield's.
TEST(Yielding, TheRestLengthFollowsAndTheElasticStrainStays) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = Precision::double_;
    NetSpec net;
    net.name = "ball";
    net.drag = 20;
    net.points = {{"m", {1, 0, 0}, 0.1, false, {}}, {"wall", {0, 0, 0}, 1.0, true, {}}};
    net.springs = {{"m", "wall", 100.0, std::nullopt, std::nullopt, {}}};
    net.plasticity.yieldStrain = 0.1;
    scene.bodies.add(net);
    scene.actions = {support::grab(0.0, "net.ball@m", true), support::moveHand(0.0, {1.5, 0, 0}, 1.0),
                     support::release(1.5)};
    World world(scene);
    run(world, 80);
    EXPECT_NEAR(world.metrics().maxStrain, 0.1, 1e-6);
    EXPECT_NEAR(world.metrics().elastic, 0.5 * 100 * std::pow(1.5 - 1.5 / 1.1, 2), 1e-5);
    run(world, 240);
    EXPECT_NEAR(world.points("net.ball@m").x[0].x, 1.5 / 1.1, 1e-6);
}

}  // namespace
}  // namespace taut::world
