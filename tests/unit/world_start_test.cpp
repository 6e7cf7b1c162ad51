// Worlds that begin with a state that an earlier one kept.
#include <gtest/gtest.h>

#include "taut/bodies/cloth.h"
#include "taut/core/error.h"
#include "taut/spec/actions.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

namespace taut::world::starting {
namespace {

constexpr int kept = 10;

// A cloth that is released at tick 4, over a ball.
SceneSpec dressing() {
    SceneSpec scene;
    ClothSpec cloth;
    cloth.name = "c";
    cloth.cells = {4, 4};
    cloth.origin = {-0.5, 0.1, 0.5};
    cloth.down = {0, 0, -1};
    cloth.hold = {"left"};
    scene.bodies.add(cloth);
    ColliderSpec ball;
    ball.name = "ball";
    ball.shape = "sphere";
    ball.radius = 0.1;
    scene.colliders = {ball};
    FreeAction free;
    free.t = 4.0 / 60;
    free.target = "cloth.c@left";
    scene.actions.add(free);
    return scene;
}

World after(const SceneSpec& scene, int number) {
    World world(scene);
    while (world.tick() < number) EXPECT_FALSE(world.advance());
    return world;
}

// Without the cause of the state.
SceneSpec later() {
    SceneSpec scene = dressing();
    scene.actions = {};
    scene.run.start = "dressed.state";
    scene.run.startState = std::make_shared<const StartState>(StartState{kept, after(dressing(), kept).save()});
    scene.run.startSource = {"s.toml", 3, 9};
    return scene;
}

TEST(StartStates, AreWhereARunGoesOnAsIfItHadNeverStopped) {
    World begun(later());
    EXPECT_EQ(begun.startTick(), kept);
    EXPECT_EQ(begun.time(), kept / 60.0);
    for (int i = 0; i < 8; ++i) ASSERT_FALSE(begun.advance());
    EXPECT_EQ(begun.save(), after(dressing(), kept + 8).save());
}

TEST(StartStates, LeaveAWorldThatTakesALaterState) {
    World world(later());
    const std::vector<std::byte> state = after(dressing(), kept + 5).save();
    world.restore(state);
    EXPECT_EQ(world.save(), state);
    ASSERT_FALSE(world.advance());
    EXPECT_EQ(world.stateHash(), after(dressing(), kept + 6).stateHash());
}

TEST(StartStates, AreRefusedByOtherBodies) {
    SceneSpec other = later();
    ClothSpec second;
    second.name = "d";
    other.bodies.add(second);
    try {
        const World world(other);
        ADD_FAILURE();
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        EXPECT_STREQ(error.what(),
                     "s.toml:3:9: error: cannot start from dressed.state: the bytes are not of this scene: its bodies "
                     "hang together in another way; keep a state of this scene's bodies, joints and colliders");
    }
}

}  // namespace
}  // namespace taut::world::starting
