#include "taut/island/private/step_following.h"

#include <gtest/gtest.h>

#include "support/small_scenes.h"
#include "support/timelines.h"
#include "taut/bodies/block.h"
#include "taut/bodies/rope.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

TEST(StepFollowing, ShortensAtOnceWhereHalfOfWhatSafetyLeavesIsGone) {
    StepFollowing following(9.5, 0.9, 60);
    EXPECT_EQ(following.substeps(), 10);
    // 10 steps at nine tenths of the limit of 10 are at 0.95 of it when ω has grown by 0.95/0.9.
    EXPECT_FALSE(following.isExceededBy(10 * 0.9499 / 0.9));
    EXPECT_TRUE(following.isExceededBy(10 * 0.9501 / 0.9));
    following.shorten(10.6);
    EXPECT_EQ(following.substeps(), 11);
}

TEST(StepFollowing, LengthensAfterASecondOfFifteenPerCentAndNoSooner) {
    StepFollowing following(100, 0.9, 60);
    for (int tick = 0; tick < 59; ++tick) following.lengthenIfCalm(80);
    EXPECT_EQ(following.substeps(), 100);
    following.lengthenIfCalm(90);  // 100/90 < 1.15: from the beginning
    for (int tick = 0; tick < 59; ++tick) following.lengthenIfCalm(tick == 30 ? 84 : 80);
    EXPECT_EQ(following.substeps(), 100);
    following.lengthenIfCalm(80);
    EXPECT_EQ(following.substeps(), 84);  // the most that the second needed
    for (int tick = 0; tick < 600; ++tick) following.lengthenIfCalm(80);
    EXPECT_EQ(following.substeps(), 84);  // 5 % are not worth it
}

// A soft block that falls flat: squeezed, its ω rises within a tick.
SceneSpec fallingBlock() {
    SceneSpec scene;
    BlockSpec block;
    block.name = "soft";
    block.size = {0.3, 0.3, 0.3};
    block.cells = {2, 2, 2};
    block.young = 4e4;
    block.bulk = 8e5;
    block.position = {0, 0.5, 0};
    block.velocity = {0, -8, 0};
    scene.bodies.add(block);
    ColliderSpec ground;
    ground.name = "ground";
    ground.shape = "plane";
    scene.colliders = {ground};
    return scene;
}

TEST(StepFollowing, RepeatsATickThatLeftItsStepBehindAndSaysSo) {
    World world(fallingBlock());
    const int before = world.islands()[0].substeps;
    for (int i = 0; i < 30; ++i) ASSERT_FALSE(world.advance());
    const IslandInfo island = world.islands()[0];
    ASSERT_FALSE(island.stepChanges.empty());
    EXPECT_EQ(island.stepChanges[0].from, before);
    EXPECT_GT(island.stepChanges[0].to, before);
    EXPECT_TRUE(island.stepChanges[0].isRepeated);
    World kept(fallingBlock(), {.keepsSteps = true});
    for (int i = 0; i < 30; ++i) ASSERT_FALSE(kept.advance());
    EXPECT_TRUE(kept.islands()[0].stepChanges.empty());
}

// Pulled so hard that it stiffens within a tick, beyond the limit of the step at its start.
TEST(StepFollowing, RepeatsATickThatDiverges) {
    SceneSpec scene;
    scene.bodies.add(support::stiffBlock("b"));
    scene.actions = {support::push(0.1, "block.b@top", {0, 200, 0})};  // N s
    World world(scene);
    for (int i = 0; i < 30; ++i) ASSERT_FALSE(world.advance()) << i;
    EXPECT_FALSE(world.islands()[0].stepChanges.empty());
}

// The rule's memory is part of the state.
TEST(StepFollowing, ARestoredWorldChangesItsStepWhereTheOtherDid) {
    const SceneSpec scene = fallingBlock();
    World through(scene);
    std::vector<std::vector<std::byte>> saved;
    for (int i = 0; i < 150; ++i) {
        if (i % 10 == 0) saved.push_back(through.save());
        ASSERT_FALSE(through.advance());
    }
    const std::vector<StepChange> changes = through.islands()[0].stepChanges;
    ASSERT_TRUE(std::any_of(changes.begin(), changes.end(), [](const StepChange& c) { return c.to < c.from; }));
    for (std::size_t from = 0; from < saved.size(); ++from) {
        World restored(scene);
        restored.restore(saved[from]);
        while (restored.tick() < 150) ASSERT_FALSE(restored.advance());
        EXPECT_EQ(restored.stateHash(), through.stateHash()) << "from tick " << 10 * from;
        EXPECT_EQ(restored.islands()[0].stepChanges.size(), changes.size());
    }
}

// Whether dashpots are split off is decided when a body comes, of dashpots that a ramp may change before it is saved.
TEST(StepFollowing, ABodyThatCameBeforeARampIsRestoredAsItWasMade) {
    SceneSpec scene;
    scene.bodies.add(support::rope("r", {0, 2, 0}, {1, 2, 0}, 20));
    RopeSpec& rope = scene.bodies.of<RopeSpec>()[0];
    rope.hold = {"start"};
    rope.dampingTime = 2e-2;
    EXPECT_TRUE(World(scene).islands()[0].splitsDashpots);
    rope.dampingTime = 1e-6;
    EXPECT_FALSE(World(scene).islands()[0].splitsDashpots);
    scene.actions = {support::action<SpawnAction>(0.1, "rope.r"),
                     support::ramp(0.2, "rope.r.damping", fields::Affects::springs, 2e-2, 0.2, Ease::linear,
                                   [](SceneSpec& s) -> double& { return s.bodies.of<RopeSpec>()[0].dampingTime; })};
    World world(scene);
    support::run(world, 30);
    World restored(scene);
    restored.restore(world.save());
    support::run(world, 10);
    support::run(restored, 10);
    EXPECT_EQ(restored.stateHash(), world.stateHash());
}

}  // namespace
}  // namespace taut::world
