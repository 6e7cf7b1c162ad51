// The input of contact from a world: cuts, ways of colliders, frozen islands.
#include <gtest/gtest.h>

#include "support/scenes.h"
#include "support/timelines.h"
#include "taut/bodies/net.h"
#include "taut/world/private/body_surfaces.h"

namespace taut::world {
namespace {

using test::positionsOf;

constexpr double thickness = 0.02;  // [m] of all
constexpr double keep = 2 * thickness;

// Two triangles in a plane y, a metre square.
ClothSpec square(double y, const std::vector<std::string>& hold) {
    ClothSpec cloth;
    cloth.name = "square";
    cloth.origin = {0, y, 0};
    cloth.cells = {1, 1};
    cloth.down = {0, 0, 1};
    cloth.hold = hold;
    cloth.touch = Touch::others;
    cloth.thickness = thickness;
    return cloth;
}
NetSpec ball(const dvec3& place, const dvec3& velocity, double mass) {
    NetSpec net;
    net.name = "ball";
    net.points = {{"only", place, mass, false, {}}};
    net.velocity = velocity;
    net.drag = 0.0;
    net.touch = Touch::others;
    net.thickness = thickness;
    return net;
}
SceneSpec sceneOf(const ClothSpec& cloth, const NetSpec& net) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.bodies.add(cloth);
    scene.bodies.add(net);
    return scene;
}

// In 0.5 s it falls by 1.2 m.
TEST(TouchingWorld, LetsThroughWhereACutTakesTrianglesAway) {
    for (const bool isCut : {false, true}) {
        World world(sceneOf(square(0.0, {"all"}), ball({0.7, 0.05, 0.3}, dvec3(0.0), 0.1)));
        EXPECT_FALSE(test::advance(world, 2));
        if (isCut) world.apply(support::cutPlane(0.0, "cloth.square", {0.5, 0, 0}, {1, 0, 0}));
        EXPECT_FALSE(test::advance(world, 30));
        const double y = positionsOf(world, "net.ball")[0].y;
        if (isCut)
            EXPECT_LT(y, -1.0);
        else
            EXPECT_NEAR(y, keep, 0.05 * keep);
    }
}

// A ball comes at 0.3 m/s, 5 mm a tick, and is out of reach by 6.5 mm and then by 1.5 mm: it meets in the middle of a
// tick that has one step.
TEST(TouchingWorld, MeetsWhatIsOutOfReachAsATickBegins) {
    constexpr double reach = 1.05 * keep;
    SceneSpec scene = sceneOf(square(0.0, {"all"}), ball({0.7, reach + 6.5e-3, 0.3}, {0.0, -0.3, 0.0}, 0.1));
    scene.world.gravity = dvec3(0.0);
    scene.solver.dt = 1.0 / 60;
    World world(scene);
    EXPECT_FALSE(world.advance());
    EXPECT_FALSE(world.advance());
    EXPECT_NEAR(positionsOf(world, "net.ball")[0].y, keep, 1e-12);
}

// A heavy ball comes at 2 m/s, 33 mm a tick of one detection. It pushes a square 5 mm below it to the ground, which is
// another 5 mm below that.
TEST(TouchingWorld, LeavesNothingInAColliderThatItPushesThere) {
    const double height = thickness + 5e-3;
    SceneSpec scene = sceneOf(square(height, {}), ball({0.6, height + keep + 5e-3, 0.3}, {0.0, -2.0, 0.0}, 20.0));
    scene.world.gravity = dvec3(0.0);
    scene.contact.detections = 1;
    ColliderSpec ground;
    ground.name = "ground";
    ground.shape = "plane";
    scene.colliders = {ground};
    World world(scene);
    EXPECT_FALSE(world.advance());
    int lying = 0;
    for (const dvec3& x : positionsOf(world, "cloth.square")) {
        EXPECT_GE(x.y, thickness - 1e-12);
        lying += x.y < thickness + 1e-12 ? 1 : 0;
    }
    EXPECT_GT(lying, 0);
}

// A belt, or a lift, with a light square on it and a heavy ball on that, all of one speed: they keep it. On the lift
// that goes down the square follows a step late: each block loses 0.5 mm, and the ball sinks until the position
// correction takes as much back, which it does at half of their distance.
TEST(TouchingWorld, LiesOnAColliderThatMovesAsOnOneThatRests) {
    for (const dvec3& speed : {dvec3(2, 0, 0), dvec3(0, 2, 0), dvec3(0, -2, 0)}) {
        ClothSpec cloth = square(thickness, {});
        cloth.velocity = speed;
        SceneSpec scene = sceneOf(cloth, ball({0.6, thickness + keep, 0.3}, speed, 2.0));
        ColliderSpec ground;
        ground.name = "ground";
        ground.shape = "plane";
        ground.keys = {{0.0, dvec3(0.0), dvec3(0.0), Ease::linear}, {10.0, 10.0 * speed, dvec3(0.0), Ease::linear}};
        scene.colliders = {ground};
        World world(scene);
        EXPECT_FALSE(test::advance(world, 30));
        const dvec3 ought = dvec3(0.6, thickness + keep, 0.3) + world.time() * speed;
        EXPECT_LT(glm::distance(positionsOf(world, "net.ball")[0], ought), (speed.y < 0 ? 0.51 : 0.05) * keep)
            << speed.x << ", " << speed.y;
    }
}

// A box that jumps by 50 m in the third tick, in which a square comes down on its corners, far from the square's own:
// bit for bit as if it had been there before.
TEST(TouchingWorld, MeetsAColliderWhereItHasJumpedTo) {
    std::vector<std::vector<dvec3>> found;
    for (const double before : {0.0, 50.0}) {
        constexpr double speed = 0.5, tick = 1.0 / 60;
        ClothSpec cloth = square(0.8 * thickness + 2.5 * speed * tick, {});  // its inside keeps so much
        cloth.velocity = {0.0, -speed, 0.0};
        SceneSpec scene = sceneOf(cloth, ball({10.0, 10.0, 10.0}, dvec3(0.0), 1.0));
        scene.world.gravity = dvec3(0.0);
        ColliderSpec box;
        box.name = "box";
        box.shape = "box";
        box.size = dvec3(0.2);
        const dvec3 there(0.5, -0.1, 0.5), far = there + dvec3(before, 0.0, 0.0);
        box.keys = {{0.0, far, dvec3(0.0), Ease::linear},
                    {2 * tick, far, dvec3(0.0), Ease::linear},
                    {3 * tick, there, dvec3(0.0), Ease::linear}};
        scene.colliders = {box};
        World world(scene);
        EXPECT_FALSE(test::advance(world, 2));
        const double coming = world.metrics("cloth.square").momentum.y;
        EXPECT_FALSE(world.advance());
        EXPECT_GT(world.metrics("cloth.square").momentum.y, 0.9 * coming);  // it is less than none
        found.push_back(positionsOf(world, "cloth.square"));
    }
    EXPECT_EQ(found[0], found[1]);
}

// A square, held at one side, that is torn out of its strain in the first tick, and a ball of a hundred times its mass
// that is at it then, or comes later: it stops there, and the square stays bit for bit where it froze.
TEST(TouchingWorld, FrozenBodiesStopOthersAndStay) {
    for (const double above : {0.0, 0.1}) {
        ClothSpec cloth = square(0.0, {"left"});
        cloth.velocity = {400.0, 0.0, 0.0};
        SceneSpec scene = sceneOf(cloth, ball({0.2, keep + above, 0.3}, {0.0, -2.0, 0.0}, 20.0));
        scene.world.gravity = dvec3(0.0);
        scene.solver.onDivergence = OnDivergence::freeze;
        scene.solver.freezeStrain = 0.5;
        World world(scene);
        EXPECT_FALSE(world.advance());
        ASSERT_EQ(world.frozen().size(), 1U);
        EXPECT_NEAR(world.metrics("net.ball").momentum.y, above > 0 ? -2.0 * 20.0 : 0.0, 1e-6) << above;
        const std::vector<dvec3> kept = positionsOf(world, "cloth.square");
        EXPECT_FALSE(test::advance(world, 10));
        EXPECT_EQ(positionsOf(world, "cloth.square"), kept) << above;
        BodySurfaces gap(world.select("net.ball"), world.select("cloth.square"));
        EXPECT_NEAR(gap.gap(), keep, 1e-6) << above;
    }
}

// The same square alone, and a box that goes through it: no shorter instant would keep them apart.
TEST(TouchingWorld, CollidersPassThroughFrozenBodiesInTicksThatEnd) {
    ClothSpec cloth = square(0.0, {"left"});
    cloth.velocity = {400.0, 0.0, 0.0};
    SceneSpec scene;
    scene.bodies.add(cloth);
    scene.world.gravity = dvec3(0.0);
    scene.solver.onDivergence = OnDivergence::freeze;
    scene.solver.freezeStrain = 0.5;
    ColliderSpec box;
    box.name = "box";
    box.shape = "box";
    box.size = dvec3(0.2);
    box.keys = {{0.0, {0.2, -0.5, 0.3}, dvec3(0.0), Ease::linear}, {0.1, {0.2, 0.5, 0.3}, dvec3(0.0), Ease::linear}};
    scene.colliders = {box};
    World world(scene);
    EXPECT_FALSE(world.advance());
    ASSERT_EQ(world.frozen().size(), 1U);
    const std::vector<dvec3> kept = positionsOf(world, "cloth.square");
    EXPECT_FALSE(test::advance(world, 6));
    EXPECT_EQ(positionsOf(world, "cloth.square"), kept);
}

}  // namespace
}  // namespace taut::world
