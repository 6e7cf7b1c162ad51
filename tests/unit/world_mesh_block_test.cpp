// Blocks that fill a mesh, in a world.
#include <gtest/gtest.h>

#include "mechanics_box_mesh.h"
#include "taut/advice/mesh_cells.h"
#include "taut/bodies/block.h"
#include "taut/core/error.h"
#include "taut/spec/private/rotation.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

std::shared_ptr<MeshData> meshOf(const mechanics::test::Mesh& boxes) {
    auto mesh = std::make_shared<MeshData>();
    mesh->positions = boxes.positions;
    mesh->triangles = boxes.triangles;
    for (std::size_t t = 0; t < boxes.triangles.size(); ++t) mesh->lines.push_back(static_cast<int>(t) + 9);
    return mesh;
}

std::shared_ptr<MeshData> boxMesh(const dvec3& low, const dvec3& high) {
    mechanics::test::Mesh mesh;
    addBox(mesh, low, high);
    return meshOf(mesh);
}

BlockSpec toy(std::shared_ptr<const MeshData> mesh) {
    BlockSpec toy;
    toy.name = "toy";
    toy.source = {"s.toml", 3, 1};
    toy.mesh = "toy.obj";
    toy.meshData = std::move(mesh);
    return toy;
}

TEST(MeshBlock, IsDrawnWhereItsFileLiesAndHeldByAGroupOfIt) {
    const auto mesh = boxMesh({0.0, 0.0, 0.0}, {41.0, 7.0, 6.0});
    mesh->groups["end"] = {0, 2, 4, 6};  // at low x
    BlockSpec block = toy(mesh);
    block.scale = 0.01;
    block.cell = 0.04;
    block.position = {1.0, 2.0, 3.0};
    block.rotation = {0.3, 0.5, 0.1};
    block.hold = {"end"};
    SceneSpec scene;
    scene.bodies.add(block);
    World world(scene);
    const auto drawn = [&] { return world.view(false).surfaces.front().geometry->positions; };
    const auto start = [&](std::size_t v) {
        return glm::vec3(block.position + rotated(rotationOf(block.rotation), 0.01 * mesh->positions[v]));
    };
    ASSERT_EQ(drawn().size(), 8U);
    for (std::size_t v = 0; v < 8; ++v) EXPECT_LT(glm::distance(drawn()[v], start(v)), 1e-6F);
    for (int i = 0; i < 12; ++i) ASSERT_FALSE(world.advance());
    for (std::size_t v = 0; v < 8; ++v) {
        const float fallen = glm::distance(drawn()[v], start(v));
        if (v % 2 == 0)
            EXPECT_LT(fallen, 1e-6F);
        else
            EXPECT_GT(fallen, 0.01F);
    }
}

// Each of its cells has a pressure of its own.
TEST(MeshBlock, GoesOnTheSameFromASavedState) {
    SceneSpec scene;
    BlockSpec block = toy(boxMesh({0.0, 0.013, 0.0}, {0.2, 0.1, 0.13}));
    block.rotation = {0.4, 0.0, 0.3};
    scene.bodies.add(block);
    ColliderSpec ground;
    ground.name = "ground";
    ground.shape = "plane";
    scene.colliders = {ground};
    World through(scene);
    for (int i = 0; i < 12; ++i) ASSERT_FALSE(through.advance());
    World restored(scene);
    restored.restore(through.save());
    for (int i = 0; i < 12; ++i) {
        ASSERT_FALSE(through.advance());
        ASSERT_FALSE(restored.advance());
    }
    EXPECT_EQ(through.save(), restored.save());
}

TEST(MeshBlock, MeshesThatCannotBeFilledAreRefused) {
    const auto refusal = [](const BlockSpec& block) -> std::string {
        SceneSpec scene;
        scene.bodies.add(block);
        try {
            World world(scene);
        } catch (const core::Error& error) {
            EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
            return error.what();
        }
        return "";
    };
    const auto mesh = boxMesh(dvec3(0.0), dvec3(1.0));
    BlockSpec block = toy(mesh);
    block.cell = 1e-6;
    EXPECT_EQ(refusal(block),
              "s.toml:3:1: error: there are 1e+18 cubes of cells_m = 1e-06 in the box around toy.obj, more than "
              "2e+06: make them larger");
    mesh->triangles.pop_back();
    const std::string open = refusal(toy(mesh));
    EXPECT_TRUE(
        open.starts_with("s.toml:3:1: error: cannot use this mesh: toy.obj:10: error: the mesh is not closed, so "
                         "that it has no inside: 3 edges"))
        << open;
}

TEST(MeshBlock, PartsThinnerThanACellAndSelfCrossingsAreReported) {
    mechanics::test::Mesh boxes;
    addBox(boxes, dvec3(0.0), {0.4, 0.4, 0.4});
    SceneSpec scene;
    scene.bodies.add(toy(meshOf(boxes)));
    EXPECT_TRUE(meshCellDoubts(scene).empty());
    addBox(boxes, {0.5, 0.0, 0.0}, {0.6, 0.4, 0.0265});
    scene.bodies.of<BlockSpec>()[0].meshData = meshOf(boxes);
    ASSERT_EQ(meshCellDoubts(scene).size(), 1U);
    EXPECT_EQ(printed(meshCellDoubts(scene)[0]),
              "block.toy: 8 % of the surface of toy.obj is of parts thinner than a cell, which bend far too stiffly: "
              "cells_m = 0.026 would do, about 3700 cells");
    // A third of 0.4 m, rounded down: 27 of them.
    boxes = {};
    addBox(boxes, dvec3(0.0), {0.4, 0.4, 0.4});
    scene.bodies.of<BlockSpec>()[0].meshData = meshOf(boxes);
    scene.bodies.of<BlockSpec>()[0].cell = 1;
    ASSERT_EQ(meshCellDoubts(scene).size(), 1U);
    EXPECT_NE(meshCellDoubts(scene)[0].text.find("cells_m = 0.13 would do, about 29 cells"), std::string::npos)
        << meshCellDoubts(scene)[0].text;
    scene.bodies.of<BlockSpec>()[0].cell = toy(meshOf(boxes)).cell;
    boxes = {};
    addBox(boxes, dvec3(0.0), {0.4, 0.4, 0.4});
    addBox(boxes, {0.3, 0.1, 0.12}, {0.6, 0.3, 0.33});
    scene.bodies.of<BlockSpec>()[0].meshData = meshOf(boxes);
    ASSERT_EQ(meshCellDoubts(scene).size(), 1U);
    EXPECT_EQ(printed(meshCellDoubts(scene)[0]),
              "block.toy: toy.obj:27 crosses itself: 10 edges go through faces, the first through this one; parts "
              "that are filled twice count once");
}

}  // namespace
}  // namespace taut::world
