// Surfaces drawn in place of a body's own triangles: a finer surface, kept out of colliders, or a mesh from a file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/small_scenes.h"
#include "taut/body/body.h"
#include "taut/collision/colliders.h"
#include "taut/collision/shape_table.h"
#include "taut/core/error.h"
#include "taut/drawing/drawing.h"
#include "taut/spec/mesh_data.h"
#include "taut/view/frame_view.h"
#include "taut/world/private/drawn_contact.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

collision::Colliders boxOfOneMetre() {
    collision::ShapeSizes sizes;
    sizes.halfSize = {0.5, 0.5, 0.5};
    collision::Shape shape;
    shape.form = collision::builtInShapes().find("box")->shape(sizes).form;
    collision::Colliders colliders;
    colliders.add(shape, {}, {});
    return colliders;
}

// A strip over an edge of a box, `high` above its top and as far beside it, its fold at `at` from the edge.
view::Geometry stripOver(float at, float high, std::vector<std::uint32_t>& triangles) {
    view::Geometry strip;
    constexpr std::uint32_t count = 35;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float s = 0.03F * (static_cast<float>(i) - 20.0F) + at;  // along it, 0 at the edge
        for (const float z : {0.0F, 0.03F}) {
            strip.positions.push_back(s < high ? glm::vec3(0.5F + s, 0.5F + high, z)
                                               : glm::vec3(0.5F + high, 0.5F + 2.0F * high - s, z));
            const float turn = glm::clamp(s / 0.06F + 0.5F, 0.0F, 1.0F);
            strip.normals.push_back(glm::normalize(glm::vec3(turn, 1.0F - turn, 0.0F)));
        }
        if (i == 0) continue;
        for (const std::uint32_t k : {2 * i - 2, 2 * i - 1, 2 * i, 2 * i - 1, 2 * i + 1, 2 * i}) triangles.push_back(k);
    }
    return strip;
}

TEST(DrawnContact, AFoldOverAnEdgeOfABoxIsLiftedOutWithoutAJumpAndNothingElseMoves) {
    const collision::Colliders box = boxOfOneMetre();
    constexpr float thickness = 0.004F;
    std::vector<glm::vec3> before;
    double farthest = 0.0, mostSunk = 0.0;
    for (float at = 0.0F; at < 0.03F; at += 0.00005F) {
        std::vector<std::uint32_t> triangles;
        const view::Geometry lying = stripOver(at, thickness, triangles);
        view::Geometry lifted = lying;
        keepOutside(box, thickness, triangles, lifted);
        for (std::size_t v = 0; v < lying.positions.size(); ++v)
            if (std::abs(static_cast<int>(v / 2) - 20) > 2) ASSERT_EQ(lifted.positions[v], lying.positions[v]);
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const std::uint32_t a = triangles[t], b = triangles[t % 3 == 2 ? t - 2 : t + 1];
            const auto depthIn = [&](const view::Geometry& strip, double share) {
                return -box.distance(glm::mix(glm::dvec3(strip.positions[a]), glm::dvec3(strip.positions[b]), share));
            };
            for (int i = 0; i <= 10; ++i) {
                mostSunk = std::max(mostSunk, depthIn(lying, 0.1 * i));
                ASSERT_LT(depthIn(lifted, 0.1 * i), 0.1 * thickness) << at;
            }
        }
        for (std::size_t v = 0; v < before.size(); ++v)
            farthest = std::max(farthest, static_cast<double>(glm::distance(before[v], lifted.positions[v])));
        before = lifted.positions;
    }
    EXPECT_GT(mostSunk, 0.4 * thickness);
    EXPECT_LT(farthest, 0.0005);  // a vertex that turns the corner goes 0.07 mm in a step; the lift follows it
}

// Of two triangles, in the corners of a square of 0.4 m and 0.1 m above it.
std::shared_ptr<const MeshData> lid(double high = 0.1) {
    auto mesh = std::make_shared<MeshData>();
    mesh->positions = {{0.3, 1.7, high}, {0.7, 1.7, high}, {0.7, 1.3, high}, {0.3, 1.3, high}};
    mesh->triangles = {{0, 2, 1}, {0, 3, 2}};
    mesh->lines = {7, 8};
    return mesh;
}

// Where `move` takes the points of the first body it takes the lid.
template <class Move>
void expectMovedAlike(const SceneSpec& scene, const Move& move) {
    const std::vector<Body> bodies = buildBodies(scene);
    std::vector<glm::vec3> moved;
    for (const dvec3& x : bodies.front().model.positions) moved.push_back(move(x));
    std::vector<view::Surface> surfaces;
    bodies.front().spec->drawing(bodies.front())->addSurfaces(moved, surfaces);
    ASSERT_EQ(surfaces.size(), 1U);
    for (std::size_t v = 0; v < 4; ++v)
        EXPECT_LT(glm::distance(surfaces.front().geometry->positions[v], move(lid()->positions[v])), 1e-5F);
}

TEST(BoundMesh, LiesWhereItsFileHasItAndGoesWithTheClothItIsBoundTo) {
    SceneSpec scene;
    ClothSpec cloth = support::cloth("a", 4);  // 0 … 1 across, 2 … 1 high, looking along z
    cloth.finish.skinData = lid();
    cloth.hold = {"all"};
    cloth.array.count = {2, 1, 1};
    cloth.array.stepX = {2.0, 0.0, 0.5};
    scene.bodies.add(cloth);
    for (const int smooth : {0, 2}) {
        scene.bodies.of<ClothSpec>()[0].finish.smooth = smooth;
        const view::FrameView view = World(scene).view(false);
        ASSERT_EQ(view.surfaces.size(), 2U);
        for (std::size_t copy = 0; copy < 2; ++copy)
            for (std::size_t v = 0; v < 4; ++v) {
                const view::Surface& drawn = view.surfaces[copy];
                const glm::dvec3 to = lid()->positions[v] + static_cast<double>(copy) * cloth.array.stepX;
                EXPECT_LT(glm::distance(drawn.geometry->positions[v], glm::vec3(to)), 1e-5F);
                // Without texture coordinates of its own it has those of the cloth under it.
                EXPECT_LT(
                    glm::distance(drawn.topology->uv[v], glm::vec2(lid()->positions[v].x, lid()->positions[v].y - 2.0)),
                    1e-5F);
            }
    }
    expectMovedAlike(scene, [](const glm::dvec3& x) { return glm::vec3(-x.z, x.y, x.x); });
}

TEST(BoundMesh, OfABlockIsStretchedWithItsCells) {
    SceneSpec scene;
    BlockSpec block = support::stiffBlock("b");
    block.position = {0.5, 1.5, 0.0};
    block.size = {0.5, 0.5, 0.4};
    block.finish.skinData = lid();
    scene.bodies.add(block);
    expectMovedAlike(
        scene, [](const glm::dvec3& x) { return glm::vec3(x); });
    expectMovedAlike(scene, [](const glm::dvec3& x) { return glm::vec3(2.0 * x.x, x.y + 0.5 * x.x, x.z); });
}

TEST(BoundMesh, AVertexFarFromTheBodyIsRefusedByTheLineOfItsFace) {
    SceneSpec scene;
    ClothSpec cloth = support::cloth("a", 4);
    cloth.source = {"s.toml", 3, 1};
    cloth.finish.skin = "lid.obj";
    cloth.finish.skinData = lid(0.9);  // the longest edge, a diagonal, is 0.35 m
    scene.bodies.add(cloth);
    try {
        World world(scene);
        FAIL() << "it was taken";
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        EXPECT_TRUE(std::string(error.what())
                        .starts_with("s.toml:3:1: error: cannot use this skin: lid.obj:7: error: a corner of this "
                                     "face is 0.9 m from cloth.a, more than 0.707 m\n"))
            << error.what();
    }
}

}  // namespace
}  // namespace taut::world
