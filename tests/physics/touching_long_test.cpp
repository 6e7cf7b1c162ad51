// Bodies that touch, where it takes long: run with --gtest_also_run_disabled_tests.
#include "touching_scenes.h"

namespace taut::test::touching {
namespace {

using world::World;

// Two opposite edges turned against each other, four turns in and out again.
TEST(TouchingLong, ATwistOfFourTurnsComesUndone) {
    world::SceneSpec spec = scene();
    spec.world.gravity = dvec3(0.0);
    spec.materials["linen"].drag = 0.5;
    spec.bodies.add(sheet("flag", {-0.5, 0.1, 0.0}, {1.0, 0, 0}, {0, -0.2, 0}, 20));
    constexpr double pi = 3.14159265358979323846;
    for (const char* side : {"left", "right"}) {
        world::GrabAction grab;
        grab.target = std::string("cloth.flag@") + side;
        grab.id = side;
        grab.rigid = true;
        spec.actions.add(grab);
        for (const bool back : {false, true}) {
            world::MoveAction turn;
            turn.t = back ? 4.0 : 0.0;
            turn.id = side;
            turn.rotation = dvec3(back ? 0.0 : (side[0] == 'l' ? 4 * pi : -4 * pi), 0.0, 0.0);
            turn.over = 4.0;
            spec.actions.add(turn);
        }
    }
    World world(spec);
    const PiercingWitness witness(spec, {"cloth.flag"});
    int pressing = 0;
    for (int i = 0; i < 60 * 9; ++i) {
        ASSERT_FALSE(world.advance());
        pressing = std::max(pressing, world.contact().lastImpulses);
        EXPECT_EQ(witness.count(world), 0) << "tick " << i;
    }
    EXPECT_GT(pressing, 20);                  // a pair for each cell of its length: it does lie on itself
    EXPECT_LT(world.metrics().elastic, 0.3);  // [J]
    EXPECT_EQ(world.contact().lastImpulses, 0);
}

TEST(TouchingLong, AStackOfTenLiesOnABall) {
    world::SceneSpec spec = scene();
    world::ColliderSpec ball;
    ball.name = "ball";
    ball.radius = 0.2;
    ball.friction = 0.6;
    spec.colliders = {ball};
    std::vector<std::string> names;
    for (int k = 0; k < 10; ++k) {
        spec.bodies.add(
            sheet("sheet" + std::to_string(k), {-0.3, 0.21 + 0.012 * k, -0.3}, {0.6, 0, 0}, {0, 0, 0.6}, 16));
        names.push_back("cloth.sheet" + std::to_string(k));
    }
    World world(spec);
    const PiercingWitness witness(spec, names);
    for (int i = 0; i < 90; ++i) {
        ASSERT_FALSE(world.advance());
        EXPECT_EQ(witness.count(world), 0) << "tick " << i;
    }
}

TEST(TouchingLong, AFineClothFoldsWithoutCrossing) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    world::ClothSpec cloth = sheet("flag", {0.0, 1.01, 0.0}, {1.0, 0, 0}, {0, -1.0, 0}, 128);
    cloth.thickness = 0.002;
    cloth.jitter = 1e-3;
    spec.bodies.add(cloth);
    World world(spec);
    const PiercingWitness witness(spec, {"cloth.flag"});
    for (int i = 0; i < 36; ++i) {
        ASSERT_FALSE(world.advance());
        EXPECT_EQ(witness.count(world), 0) << "tick " << i;
    }
}

}  // namespace
}  // namespace taut::test::touching
