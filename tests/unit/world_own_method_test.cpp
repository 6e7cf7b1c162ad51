// A world whose scene brings a method of its own along.
#include <gtest/gtest.h>

#include <memory>

#include "support/small_scenes.h"
#include "taut/bodies/rope.h"
#include "taut/core/error.h"
#include "taut/ode/method_table.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

// The engine's midpoint method under another name.
ode::Methods withMine() {
    ode::MethodInfo mine = *ode::findMethod("midpoint");
    mine.name = "mine";
    mine.title = "my method";
    ode::Methods methods = ode::builtInMethods();
    methods.add(mine);
    return methods;
}

World swinging(const std::string& integrator, std::shared_ptr<const ode::Methods> methods) {
    SceneSpec scene;
    scene.bodies.add(support::rope("line", {0, 0, 0}, {1, 0, 0}));
    scene.bodies.of<RopeSpec>()[0].hold = {"start"};
    scene.solver.integrator = integrator;
    scene.solver.methods = std::move(methods);
    World world(scene);
    for (int i = 0; i < 10; ++i) world.advance();
    return world;
}

TEST(OwnMethodInAWorld, ChoosesTheStepAndMovesTheBodies) {
    const World mine = swinging("mine", std::make_shared<ode::Methods>(withMine()));
    const World same = swinging("midpoint", nullptr);
    EXPECT_EQ(mine.islands()[0].method, "mine");
    EXPECT_EQ(mine.islands()[0].step, same.islands()[0].step);
    EXPECT_EQ(mine.stateHash(), same.stateHash());
    EXPECT_THROW(swinging("mine", nullptr), core::Error);
}

TEST(OwnMethodInAWorld, StandsInASceneOfTheSceneAndOfABody) {
    scene::LoadOptions options;
    Kinds kinds = builtIn();
    kinds.methods = withMine();
    options.kinds = std::make_shared<const Kinds>(kinds);
    const std::string text =
        "schema = 1\nsolver.integrator = \"mine\"\n"
        "[rope.line]\nends = [[0, 0, 0], [1, 0, 0]]\nsolver = { integrator = \"mine\" }\n";
    EXPECT_EQ(World(scene::loadSceneText(text, "s.toml", options).spec).islands()[0].method, "mine");
    EXPECT_THROW(scene::loadSceneText(text, "s.toml", {}), core::Error);
}

}  // namespace
}  // namespace taut::world
