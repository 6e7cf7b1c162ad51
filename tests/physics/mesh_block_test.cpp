// Soft bodies of a mesh: the mesh touches, not the cells that carry it.
#include <memory>

#include "taut/spec/actions.h"
#include "taut/world/private/body_surfaces.h"
#include "touching_scenes.h"

namespace taut::test::touching {
namespace {

using world::BlockSpec;
using world::World;

BlockSpec block(const std::string& name, std::shared_ptr<const world::MeshData> mesh, double cell) {
    BlockSpec spec;
    spec.name = name;
    spec.meshData = std::move(mesh);
    spec.cell = cell;
    spec.density = 200;
    spec.young = 2e4;
    spec.thickness = keep / 2;
    spec.touch = world::Touch::others;
    return spec;
}

std::shared_ptr<const world::MeshData> cube(double side) {
    auto mesh = std::make_shared<world::MeshData>();
    for (int c = 0; c < 8; ++c) mesh->positions.push_back(side * (dvec3(c & 1, (c >> 1) & 1, c >> 2) - 0.5));
    for (const auto& [a, b, c, d] :
         {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        mesh->triangles.push_back({a, b, c});
        mesh->triangles.push_back({a, c, d});
    }
    return mesh;
}

std::shared_ptr<const world::MeshData> ball(double radius) {
    constexpr double turn = 2 * 3.14159265358979323846;
    constexpr int around = 24, rows = 12;
    auto mesh = std::make_shared<world::MeshData>();
    for (int j = 1; j < rows; ++j)
        for (int i = 0; i < around; ++i) {
            const double a = turn * i / around, b = 0.5 * turn * j / rows;
            mesh->positions.push_back(radius *
                                      dvec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)));
        }
    const int top = static_cast<int>(mesh->positions.size()), bottom = top + 1;
    mesh->positions.push_back({0, radius, 0});
    mesh->positions.push_back({0, -radius, 0});
    const auto at = [](int j, int i) { return j * around + i % around; };
    for (int i = 0; i < around; ++i) {
        mesh->triangles.push_back({top, at(0, i + 1), at(0, i)});
        mesh->triangles.push_back({bottom, at(rows - 2, i), at(rows - 2, i + 1)});
        for (int j = 0; j + 2 < rows; ++j) {
            mesh->triangles.push_back({at(j, i), at(j, i + 1), at(j + 1, i + 1)});
            mesh->triangles.push_back({at(j, i), at(j + 1, i + 1), at(j + 1, i)});
        }
    }
    return mesh;
}

// [m]
std::vector<glm::vec3> drawn(const World& world, const std::string& name) {
    for (const view::Surface& surface : world.view(false).surfaces)
        if (surface.name == name) return surface.geometry->positions;
    return {};
}

// A cube that lies askew in its cells falls onto an edge and comes to lie on a face. Its corners keep the thickness,
// though the cells go below.
TEST(MeshBlock, LiesOnItsMesh) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    const auto mesh = cube(0.2);
    auto askew = std::make_shared<world::MeshData>(*mesh);
    for (dvec3& x : askew->positions) {
        x = {0.8 * x.x - 0.6 * x.y, 0.6 * x.x + 0.8 * x.y, x.z};
        x = {x.x, 0.96 * x.y - 0.28 * x.z, 0.28 * x.y + 0.96 * x.z};
    }
    for (const world::Touch touch : {world::Touch::others, world::Touch::nothing}) {
        spec.bodies = {};
        BlockSpec own = block("cube", askew, 0.07);
        own.position = {0, 0.2, 0};
        own.touch = touch;
        spec.bodies.add(own);
        World world(spec);
        double lowest = 0;
        for (int i = 0; i < 120; ++i) {
            ASSERT_FALSE(world.advance());
            lowest = 1;
            for (const glm::vec3& x : drawn(world, "block.cube")) lowest = std::min(lowest, static_cast<double>(x.y));
            EXPECT_GT(lowest, 0.9 * own.thickness) << i;
        }
        EXPECT_NEAR(world::BodySurfaces(world.select("block.cube")).lowest().x.y, lowest, 1e-6);
        EXPECT_LT(lowest, 1.1 * own.thickness);
        EXPECT_GE(world.metrics().contacts, 4);
        double below = 0;
        for (const dvec3& x : positionsOf(world, "block.cube")) below = std::min(below, x.y);
        EXPECT_LT(below, -0.01);
    }
}

// A stiff ball, light at the corners of its cells, falls onto the ground: its energy of springs, motion and
// height is at no time more than it began with.
TEST(MeshBlock, GainsNoEnergyAsItLands) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    BlockSpec own = block("ball", ball(0.2), 0.04);
    own.young = 2e5;
    own.position = {0, 0.35, 0};
    own.touch = world::Touch::nothing;
    spec.bodies.add(own);
    World world(spec);
    const double before = world.metrics().energy();
    double softest = 0;
    for (int i = 0; i < 20; ++i) {
        ASSERT_FALSE(world.advance());
        EXPECT_LT(world.metrics().energy(), 1.0001 * before) << i;
        softest = std::max(softest, world.metrics().elastic);
    }
    EXPECT_GT(softest, 0.2 * before);
}

// A ball, and a cube of twelve triangles, are cut aslant in the air, and nothing stirs. The drawn pieces are
// the body, open nowhere: seen from far away its volume is that of the mesh.
TEST(MeshBlock, IsDrawnUpToTheCut) {
    for (const auto& mesh : {ball(0.2), cube(0.4)}) {
        SCOPED_TRACE(mesh->triangles.size());
        world::SceneSpec spec = scene(0.0);
        spec.world.gravity = dvec3(0.0);
        BlockSpec own = block("body", mesh, 0.05);
        own.touch = world::Touch::all;
        own.drag = 0;
        spec.bodies.add(own);
        World world(spec);
        const auto volume = [&] {
            const dvec3 far(7.0, 5.0, 3.0);
            double sixfold = 0;
            for (const auto& t : world.triangles(world.select("block.body")))
                sixfold += glm::dot(t[0] - far, glm::cross(t[1] - far, t[2] - far));
            return sixfold / 6;
        };
        const double whole = volume();
        world::CutAction cut;
        cut.target = "block.body";
        cut.planePoint = dvec3(0.02, 0.07, 0.01);
        cut.planeNormal = glm::normalize(dvec3(0.3, 1.0, 0.2));
        cut.perform(world);
        for (int i = 0; i < 20; ++i) ASSERT_FALSE(world.advance());
        EXPECT_NEAR(volume(), whole, 1e-3 * whole);
        EXPECT_EQ(world.metrics().crossings, 0);
        EXPECT_LT(world.metrics().kinetic, 1e-6);
    }
}

// A ball that lies on the ground is cut near its top, and across into slices of one layer of points: nothing jumps, and
// pieces without a complete cell lie on the ground too.
TEST(MeshBlock, IsCutWhereItLies) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    for (const bool isSliced : {false, true}) {
        spec.bodies = {};
        BlockSpec own = block("ball", ball(0.2), 0.09);
        own.young = 2e5;
        own.position = {0, 0.2 + own.thickness, 0};
        own.touch = world::Touch::all;
        spec.bodies.add(own);
        World world(spec);
        for (int i = 0; i < 20; ++i) ASSERT_FALSE(world.advance());
        const double before = world.metrics().energy();
        world::CutAction cut;
        cut.target = "block.ball";
        cut.planePoint = isSliced ? dvec3(-0.04, 0, 0) : dvec3(0, 0.37, 0);
        cut.planeNormal = isSliced ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        cut.perform(world);
        if (isSliced) {
            cut.planePoint = dvec3(0.04, 0, 0);
            cut.perform(world);
        }
        for (int i = 0; i < 60; ++i) {
            ASSERT_FALSE(world.advance());
            EXPECT_LT(world.metrics().energy(), before + 1e-3 * std::abs(before)) << i;
        }
        for (const dvec3& x : positionsOf(world, "block.ball"))
            EXPECT_GT(x.y, -0.09);  // corners of its cells stand out
    }
}

// Its cells fill the cube exactly, and are much smaller than its twelve triangles.
TEST(MeshBlock, LiesOnTheGroundWhereItIsCut) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    BlockSpec own = block("cube", cube(0.2), 0.025);
    own.position = {0, 0.15, 0};
    own.touch = world::Touch::nothing;
    spec.bodies.add(own);
    World world(spec);
    world::CutAction cut;
    cut.target = "block.cube";
    cut.planePoint = dvec3(0.0);
    cut.planeNormal = dvec3(1.0, 0.0, 0.0);
    cut.perform(world);
    for (int i = 0; i < 60; ++i) ASSERT_FALSE(world.advance());
    EXPECT_GT(world.metrics().brokenSprings, 0);
    for (const glm::vec3& x : drawn(world, "block.cube")) EXPECT_GT(static_cast<double>(x.y), 0.9 * own.thickness);
}

// Two meet in the air: momentum passes from one to the other. Where they press each other is found once in a block of
// steps, so the places slide past each other by a millimetre, which is the lever that angular momentum is lost by.
TEST(MeshBlock, KeepsMomentumAndItsMoment) {
    world::SceneSpec spec = scene(0.0);
    spec.world.gravity = dvec3(0.0);
    BlockSpec a = block("a", cube(0.2), 0.08), b = block("b", ball(0.1), 0.06);
    a.rotation = {0.3, 0.2, 0.5};
    a.velocity = {1.0, 0.0, 0.0};
    a.drag = b.drag = 0;
    b.position = {0.3, 0.06, 0.04};
    spec.bodies.add(a);
    spec.bodies.add(b);
    World world(spec);
    const world::Metrics before = world.metrics();
    for (int i = 0; i < 30; ++i) {
        ASSERT_FALSE(world.advance());
        EXPECT_EQ(world.metrics().crossings, 0);
        EXPECT_LT(world.metrics().energy(), 1.01 * before.energy());
    }
    const world::Metrics now = world.metrics();
    EXPECT_GT(world.metrics("block.b").momentum.x, 0.3 * before.momentum.x);
    EXPECT_LT(glm::distance(now.momentum, before.momentum), 1e-12 * glm::length(before.momentum));
    EXPECT_LT(glm::distance(now.angularMomentum, before.angularMomentum), 1e-3 * glm::length(before.momentum));
}

// A ball is drawn by its weight through a ring that is a seventh narrower.
TEST(MeshBlock, GoesThroughANarrowRing) {
    world::SceneSpec spec = scene(0.1);
    spec.world.gravity = {0, -60, 0};
    spec.colliders = {ring(0.115, 0.03)};
    BlockSpec own = block("ball", ball(0.1), 0.04);
    own.position = {0.01, 0.1, 0};
    own.young = 1e4;
    spec.bodies.add(own);
    World world(spec);
    const auto drawnWidth = [&] {
        float most = 0;
        for (const glm::vec3& x : drawn(world, "block.ball"))
            if (std::abs(x.y) < 0.01F) most = std::max(most, std::hypot(x.x, x.z));
        return most;
    };
    float widest = 0;
    for (int i = 0; i < 10; ++i) {
        ASSERT_FALSE(world.advance());
        const world::Metrics now = world.metrics();
        EXPECT_EQ(now.invertedCells, 0) << i;
        EXPECT_LT(now.penetration, own.thickness) << i;
        EXPECT_LT(now.facePenetration, own.thickness) << i;
        widest = std::max(widest, drawnWidth());
    }
    EXPECT_GT(widest, 0.08);
    EXPECT_LT(widest, 0.085);
    for (const dvec3& x : positionsOf(world, "block.ball")) EXPECT_LT(x.y, -0.03);
}

}  // namespace
}  // namespace taut::test::touching
