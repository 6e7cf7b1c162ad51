// The entity-component part earns its place: a new component with its system, and entities that come and go in
// mid-run, without a change to the world.
#include <gtest/gtest.h>

#include <cmath>

#include "support/small_scenes.h"
#include "support/timelines.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/core/trig.h"
#include "taut/forces/anchor.h"
#include "taut/spec/private/rotation.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

using support::run;

// A component that only this test knows: it turns its body about the vertical.
struct Spinner {
    double rate;  // [rad/s]
};

void turnSpinners(World& world, double t, double) {
    world.registry().each<Spinner, Placement>([&](ecs::Entity, const Spinner& spinner, Placement& placement) {
        placement.to.rotation = rotationOf({0.0, spinner.rate * t, 0.0});
    });
}

ecs::Entity named(World& world, const std::string& name) {
    ecs::Entity found;
    world.registry().each<Identity>([&](ecs::Entity entity, const Identity& identity) {
        if (identity.fullName() == name) found = entity;
    });
    return found;
}

double lowest(const World& world, ecs::Entity body) {
    double y = HUGE_VAL;
    for (const dvec3& x : world.positions(body)) y = std::min(y, x.y);
    return y;
}

TEST(Components, ANewComponentWithItsSystemMovesACollider) {
    SceneSpec scene;
    scene.bodies.add(support::rope("stick", {0.5, 0.52, 0.3}, {0.9, 0.52, 0.3}, 4));
    ColliderSpec table;
    table.name = "table";
    table.shape = "box";
    table.size = {4.0, 1.0, 4.0};
    table.friction = 1.0;
    scene.colliders = {table};
    World world(scene);
    const ecs::Entity stick = named(world, "rope.stick");
    world.addSystem(turnSpinners);
    run(world, 20);
    const dvec3 before = world.positions(stick)[0];
    world.registry().add(named(world, "collider.table"), Spinner{1.0});
    run(world, 60);
    // Friction takes the stick along: about the angle that the table turns while the stick lies on it.
    const dvec3 after = world.positions(stick)[0];
    const double turned = std::atan2(before.z, before.x) - std::atan2(after.z, after.x);
    EXPECT_GT(turned, 0.5);
    EXPECT_NEAR(std::hypot(after.x, after.z), std::hypot(before.x, before.z), 0.1);
}

TEST(Components, ACylinderSpawnedInMidRunCatchesWhatFalls) {
    SceneSpec scene;
    scene.bodies.add(support::rope("stick", {-0.2, 3.0, 0.0}, {0.2, 3.0, 0.0}, 8));
    World with(scene), without(scene);
    run(with, 6);
    run(without, 6);
    EXPECT_EQ(with.stateHash(), without.stateHash());
    ColliderSpec shelf;
    shelf.name = "shelf";
    shelf.shape = "cylinder";
    shelf.radius = 1.0;
    shelf.height = 0.2;
    shelf.position = {0.0, 2.0, 0.0};
    const ecs::Entity spawned = with.spawn(shelf);
    run(with, 60);
    run(without, 60);
    const ecs::Entity stick = named(with, "rope.stick");
    EXPECT_NEAR(lowest(with, stick), 2.1 + 0.02, 2e-3);  // on top, at its radius; the margin of a round shape
    EXPECT_LT(lowest(without, named(without, "rope.stick")), 0.0);
    with.destroy(spawned);
    run(with, 60);
    EXPECT_LT(lowest(with, stick), 1.0);  // falls again
}

TEST(Components, ABodySpawnedInMidRunFallsAndCollidesAndGoes) {
    SceneSpec scene;
    scene.bodies.add(support::rope("a", {0, 3, 0}, {1, 3, 0}, 4));
    scene.colliders = {support::ground()};
    World world(scene);
    run(world, 10);
    const ecs::Entity cloth = world.spawn([] {
        ClothSpec spec = support::cloth("late");
        spec.origin = {0.0, 0.3, 0.0};
        spec.down = {0.0, 0.0, 1.0};
        return spec;
    }());
    EXPECT_EQ(world.islands().size(), 2U);
    run(world, 60);
    EXPECT_NEAR(lowest(world, cloth), 0.005, 1e-5);  // lies on the ground at its thickness, in single precision
    const std::uint64_t with = world.stateHash();
    world.destroy(cloth);
    EXPECT_EQ(world.islands().size(), 1U);
    run(world, 1);
    EXPECT_NE(world.stateHash(), with);
}

TEST(Components, ASpawnedBodyIsHeldAndMovesAsItsSpecSays) {
    World world{SceneSpec{}};
    RopeSpec spec = support::rope("late", {0, 3, 0}, {1, 3, 0});
    spec.hold = {"start"};
    spec.velocity = {0, 0, 3};
    const ecs::Entity rope = world.spawn(spec);
    EXPECT_GT(world.metrics().momentum.z, 2.0);  // 1 kg at 3 m/s, less the held point and the energy of its spring
    run(world, 6);
    EXPECT_EQ(world.positions(rope)[0], dvec3(0, 3, 0));
    EXPECT_NEAR(world.positions(rope)[10].z, 0.3, 0.03);  // a tenth of a second at 3 m/s, before the rope turns it much
}

TEST(Components, AnAnchorMayLoseItsBody) {
    SceneSpec scene;
    scene.bodies.add(support::rope("a", {0, 3, 0}, {1, 3, 0}));
    AnchorSpec anchor;
    anchor.name = "hand";
    anchor.target = "rope.a@start";
    anchor.at = {0, 3, 0};
    scene.forces.add(anchor);
    World world(scene);
    run(world, 3);
    world.destroy(named(world, "rope.a"));
    const ecs::Entity late = world.spawn(support::rope("b", {0, 3, 0}, {1, 3, 0}));
    run(world, 3);
    EXPECT_LT(world.positions(late)[0].y, 3.0);
}

TEST(Components, SpawningIsTheSameInEveryRun) {
    const auto hash = [](int threads) {
        SceneSpec scene;
        scene.bodies.add(support::rope("a", {0, 3, 0}, {1, 3, 0}));
        scene.colliders = {support::ground()};
        World world(scene, {.threads = threads});
        for (int i = 0; i < 40; ++i) {
            EXPECT_FALSE(world.advance());
            if (i == 7) world.spawn(support::rope("0-first-by-name", {0, 2, 0}, {1, 2, 0.5}));
            if (i == 11) world.spawn(support::ball("b", {0.5, 1.0, 0.0}, 0.3));
        }
        return world.stateHash();
    };
    EXPECT_EQ(hash(1), hash(3));
}

}  // namespace
}  // namespace taut::world
