// The promises of the shipped scenes, played to their ends.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "support/scenes.h"
#include "taut/bodies/cloth.h"
#include "taut/scene/load.h"

namespace taut::test::shipped_scenes {
namespace {

world::World shipped(const std::string& name, std::vector<std::string> overrides = {}) {
    const std::filesystem::path assets = std::filesystem::path(TAUT_SOURCE_DIR) / "assets";
    scene::LoadOptions options;
    options.assetFolders = {assets};
    options.overrides = std::move(overrides);
    return world::World(scene::loadScene(assets / "scenes" / (name + ".toml"), options).spec);
}

// The hardest impact comes after 1.7 s. That no cell turns inside out and how small one gets is a matter of the
// scenario of that name.
TEST(ShippedScenes, JellyStaysWithinItsWorkingStretch) {
    world::World world = shipped("jelly");
    while (world.time() < 2.0) ASSERT_FALSE(world.advance());
    EXPECT_TRUE(world.warnings().empty());
}

// At half the resolution, which friction does not know; the scenario of that name plays the whole cloth for as long as
// its golden pictures need. A cloth of about half a kilogram that moved on as a whole at 5 cm/s would have 0.6 mJ.
TEST(ShippedScenes, DrapeComesToRestOnBallAndBox) {
    world::World world = shipped("drape", {"cloth.tablecloth.cells=[38, 28]"});
    while (world.time() < 5.0) ASSERT_FALSE(world.advance());
    const std::vector<dvec3> early = positionsOf(world, "cloth.tablecloth");
    EXPECT_LT(world.metrics().kinetic, 6e-4);
    EXPECT_GT(world.metrics().contacts, 100);
    while (world.time() < 5.5) ASSERT_FALSE(world.advance());
    dvec3 way(0.0);  // corners swing on; the cloth as a whole does not slide
    const std::vector<dvec3> late = positionsOf(world, "cloth.tablecloth");
    for (std::size_t i = 0; i < late.size(); ++i) way += (late[i] - early[i]) / static_cast<double>(late.size());
    EXPECT_LT(glm::length(way), 0.0025);  // half a second at 5 mm/s
}

// The ball is put half a metre aside within one tick, through the cloth that lies on it.
TEST(ShippedScenes, AJumpingColliderDoesNotExplodeACloth) {
    world::SceneSpec scene;
    world::ClothSpec cloth;
    cloth.name = "cover";
    cloth.origin = {-0.5, 0.72, -0.5};
    cloth.down = {0.0, 0.0, 1.0};
    cloth.jitter = 1e-4;
    scene.bodies.add(cloth);
    world::ColliderSpec ball;
    ball.name = "ball";
    ball.radius = 0.3;
    ball.position = {0.0, 0.4, 0.0};
    ball.friction = 0.5;
    ball.keys = {{0.0, ball.position, {}, world::Ease::hold},
                 {1.0, ball.position, {}, world::Ease::hold},
                 {1.0 + 1.0 / 60.0, {0.5, 0.4, 0.0}, {}, world::Ease::linear}};
    scene.colliders = {ball};
    world::World world(scene);
    double energy = 0.0;
    while (world.time() < 1.0) ASSERT_FALSE(world.advance());
    for (int tick = 0; tick < 60; ++tick) {
        ASSERT_FALSE(world.advance());
        energy = std::max(energy, world.metrics().kinetic + world.metrics().elastic);
    }
    // 0.2 kg of cloth carried off at no more than the ball's 30 m/s has 90 J; an explosion has no bound.
    EXPECT_LT(energy, 90.0);
    // One second later there is only a cloth that falls or hangs: 0.2 kg at 10 m/s.
    EXPECT_LT(world.metrics().kinetic, 10.0);
    EXPECT_LT(world.metrics().maxStrain, 0.5);
}

}  // namespace
}  // namespace taut::test::shipped_scenes
