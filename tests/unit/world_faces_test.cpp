// Corners and edges of colliders against the surface between the points of bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/timelines.h"
#include "taut/contact/closest_points.h"
#include "taut/core/trig.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

using core::pi;
using support::run;

constexpr double gap = 0.01;
constexpr double gapBetween = 0.8 * gap;  // distance of edges and faces from colliders

// A box of the edge a that stands on a corner; the opposite one at `top`.
ColliderSpec onCorner(const dvec3& top, double a = 0.3) {
    ColliderSpec box;
    box.name = "box";
    box.shape = "box";
    box.size = dvec3(a);
    box.rotation = {pi / 4, 0, std::atan(std::sqrt(0.5))};
    box.position = top - dvec3(0, 0.5 * std::sqrt(3.0) * a, 0);
    box.friction = 0.4;
    return box;
}

// Level, of 0.6 m, its middle in the middle of a triangle of its cells.
ClothSpec sheetAt(double height, int cells = 6) {
    ClothSpec cloth = support::cloth("c", cells);
    cloth.size = {0.6, 0.6};
    const double cell = 0.6 / cells;
    cloth.origin = {-0.3 + cell / 3, height, -0.3 + cell / 6};
    cloth.down = {0, 0, 1};
    cloth.thickness = gap;
    cloth.material = "m";
    cloth.meetsFaces = true;
    return cloth;
}

SceneSpec sceneOf(const ClothSpec& cloth, const ColliderSpec& collider) {
    SceneSpec scene;
    scene.materials["m"].stretch = 200;
    scene.materials["m"].bend = 0.5;
    scene.bodies.add(cloth);
    scene.colliders = {collider};
    return scene;
}

ecs::Entity entityOf(World& world, const std::string& kind) {
    ecs::Entity found{};
    world.registry().each<Identity>([&](ecs::Entity entity, const Identity& identity) {
        if (identity.kind == kind) found = entity;
    });
    return found;
}

// [m] from a place to the nearest triangle of the cloth.
double distanceTo(World& world, const dvec3& place) {
    const ecs::Entity entity = entityOf(world, "cloth");
    const std::vector<dvec3> x = world.positions(entity);
    double least = 1e300;
    for (const std::array<int, 3>& t : world.registry().find<BodyPart>(entity)->body->model.triangles) {
        const auto at = [&](std::size_t k) { return x[t[k]]; };
        least = std::min(least, glm::length(contact::closestPoints({place, at(0), at(1), at(2)}, true).separation));
    }
    return least;
}

double lowest(World& world) {
    double least = 1e300;
    for (const dvec3& x : world.positions(entityOf(world, "cloth"))) least = std::min(least, x.y);
    return least;
}

// By points alone the corner goes through, which penetration() does not see.
TEST(Faces, ASheetRestsAtFourFifthsOfItsThicknessOverACorner) {
    const dvec3 top{0, 0.5, 0};
    for (const bool meets : {false, true}) {
        ClothSpec cloth = sheetAt(0.52);
        cloth.hold = {"corners"};
        cloth.meetsFaces = meets;
        World world(sceneOf(cloth, onCorner(top)));
        for (int i = 0; i < 120; ++i) {
            run(world, 1);
            EXPECT_EQ(world.metrics().facePenetration, 0.0);
        }
        EXPECT_LT(world.metrics().penetration, 1e-6);
        if (meets)
            EXPECT_NEAR(distanceTo(world, top), gapBetween, 0.01 * gap);
        else
            EXPECT_GT(distanceTo(world, top), 2 * gap);  // it hangs below
    }
}

TEST(Faces, ACornerAtFiveMetresASecondDoesNotGoThroughAHangingCloth) {
    ClothSpec cloth = sheetAt(0);
    cloth.origin = {-0.3 + 0.1 / 3, 1, 0};
    cloth.down = {0, -1, 0};
    cloth.hold = {"top"};
    ColliderSpec box = onCorner({0, 0, 0}, 0.15);
    box.rotation.x += pi / 2;  // towards z
    box.keys = {{0, {0, 0.7, -0.3}, box.rotation, Ease::linear}, {0.2, {0, 0.7, 0.7}, box.rotation, Ease::linear}};
    World world(sceneOf(cloth, box));
    for (int i = 0; i < 12; ++i) {
        run(world, 1);
        EXPECT_EQ(world.metrics().facePenetration, 0.0);
    }
    // The cloth that hung in its way is ahead of it.
    double furthest = -1;
    for (const dvec3& x : world.positions(entityOf(world, "cloth"))) furthest = std::max(furthest, x.z);
    EXPECT_GT(furthest, 0.3);
}

TEST(Faces, ACornerThatIsThroughAtTheStartComesOut) {
    ClothSpec cloth = sheetAt(0.48);
    World world(sceneOf(cloth, onCorner({0, 0.5, 0})));
    EXPECT_NEAR(world.metrics().facePenetration, 0.02, 1e-6);  // the scene's, in single precision
    run(world, 30);
    EXPECT_EQ(world.metrics().facePenetration, 0.0);
    EXPECT_GE(distanceTo(world, {0, 0.5, 0}), 0.95 * gapBetween);
}

TEST(Faces, ABallSmallerThanACellHoldsATriangleAtItsRadius) {
    ClothSpec cloth = sheetAt(0.58, 2);
    cloth.hold = {"corners"};
    World world(sceneOf(cloth, support::ball("ball", {0, 0.5, 0}, 0.05)));
    run(world, 120);
    EXPECT_NEAR(distanceTo(world, {0, 0.5, 0}), 0.05 + gap, 0.05 * (0.05 + gap));
}

TEST(Faces, ARopeLiesOnAnEdgeBetweenItsPoints) {
    SceneSpec scene;
    RopeSpec rope = support::rope("r", {-0.15, 0.6, 0}, {0.15, 0.6, 0}, 3);
    rope.thickness = gap;
    rope.meetsFaces = true;
    scene.bodies.add(rope);
    ColliderSpec blade;
    blade.name = "blade";
    blade.shape = "box";
    blade.size = {0.002, 0.4, 0.6};
    blade.position = {0, 0.3, 0};
    blade.friction = 0.5;
    scene.colliders = {blade};
    World world(scene);
    run(world, 90);
    const std::vector<dvec3> x = world.positions(entityOf(world, "rope"));
    EXPECT_NEAR(0.5 * (x[1].y + x[2].y), 0.5 + gapBetween, 0.01 * gap);
}

SceneSpec moving() {
    ClothSpec cloth = sheetAt(0.56);
    ColliderSpec box = onCorner({0, 0.5, 0});
    const dvec3 at = box.position, turn = box.rotation;
    box.keys = {{0.1, at, turn, Ease::linear}, {0.3, at + dvec3(0.1, 0.05, 0), turn + dvec3(0, 0.5, 0), Ease::linear}};
    SceneSpec scene = sceneOf(cloth, box);
    ClothSpec other = sheetAt(0.6, 4);
    other.name = "d";
    other.touch = Touch::others;
    other.meetsFaces = false;
    scene.bodies.add(other);
    return scene;
}

TEST(Faces, TheStateIsTheSameWithAnyNumberOfThreadsAndFromAnyTickOn) {
    constexpr int ticks = 24;
    const SceneSpec scene = moving();
    World through(scene, {.threads = 1});
    std::vector<std::vector<std::byte>> saved;
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < ticks; ++i) {
        saved.push_back(through.save());
        run(through, 1);
        hashes.push_back(through.stateHash());
        if (i % 3 == 0) (void)through.metrics();  // queries change nothing
    }
    for (const int threads : {2, 7}) {
        World world(scene, {.threads = threads});
        run(world, ticks);
        EXPECT_EQ(world.stateHash(), hashes.back());
    }
    for (std::size_t i = 0; i < saved.size(); ++i) {
        World world(scene);
        world.restore(saved[i]);
        run(world, 1);
        EXPECT_EQ(world.stateHash(), hashes[i]);
        run(world, ticks - 1 - static_cast<int>(i));
        EXPECT_EQ(world.stateHash(), hashes.back());
    }
}

// Faster than 100 m/s it has no way: bodies between do not feel it.
TEST(Faces, AColliderThatJumpsPassesWhatLiesBetween) {
    ClothSpec cloth = sheetAt(0);
    cloth.origin = {-0.3, 1, 0};
    cloth.down = {0, -1, 0};
    cloth.hold = {"top"};
    ColliderSpec box = onCorner({0, 0, 0}, 0.15);  // in none of 16 substeps at the cloth
    box.keys = {{0, {0, 0.7, -5.3}, box.rotation, Ease::linear}, {0.1, {0, 0.7, 4.7}, box.rotation, Ease::hold}};
    World jumped(sceneOf(cloth, box));
    box.keys.pop_back();
    World stays(sceneOf(cloth, box));
    run(jumped, 12);
    run(stays, 12);
    EXPECT_EQ(jumped.stateHash(), stays.stateHash());
}

TEST(Faces, CollidersThatComeAreMetAndThoseThatGoAreNot) {
    SceneSpec scene = sceneOf(sheetAt(0.52), onCorner({0, 0.5, 0}));
    const ColliderSpec box = scene.colliders[0];
    scene.colliders.clear();
    World world(scene);
    const ecs::Entity entity = world.spawn(box);
    run(world, 30);
    EXPECT_EQ(world.metrics().facePenetration, 0.0);
    EXPECT_NEAR(distanceTo(world, {0, 0.5, 0}), gapBetween, 0.1 * gap);
    const double before = lowest(world);
    world.destroy(entity);
    run(world, 30);
    EXPECT_LT(lowest(world), before - 0.5);
}

}  // namespace
}  // namespace taut::world
