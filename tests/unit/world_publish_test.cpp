#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/small_scenes.h"
#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/drawing/drawing.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

SceneSpec smallScene() {
    SceneSpec scene;
    scene.bodies.add(support::cloth("a", 4));
    scene.bodies.add(support::rope("b", {0, 1, 0}, {1, 1, 0}));
    scene.colliders = {support::ball("ball", {0, 1, 0}, 0.3), support::ground()};
    scene.cameras.resize(2);
    scene.cameras[0].name = "close";
    scene.cameras[0].eye = {1, 1, 1};
    scene.cameras[1].name = "far";
    scene.cameras[1].eye = {9, 9, 9};
    return scene;
}

const view::Surface* surface(const view::FrameView& view, const std::string& name) {
    for (const view::Surface& s : view.surfaces)
        if (s.name == name) return &s;
    return nullptr;
}

TEST(Publish, EveryBodyAndVisibleColliderIsASurfaceAndTheLevelPlaneTheGround) {
    const view::FrameView view = World(smallScene()).view(false);
    EXPECT_EQ(view.surfaces.size(), 3U);
    ASSERT_NE(surface(view, "cloth.a"), nullptr);
    EXPECT_TRUE(surface(view, "cloth.a")->twoSided);
    EXPECT_EQ(surface(view, "cloth.a")->topology->triangles.size(), 3U * 32U);
    ASSERT_TRUE(view.ground);
    EXPECT_EQ(view.ground->height, 0.0F);
    EXPECT_TRUE(view.marks.lines.empty());
}

// In the air: y = −g t² / 2, after which a lag T takes the camera by −g (t² / 2 − T t + T² (1 − exp(−t / T))).
TEST(Publish, ACameraFollowsABodyWithItsLag) {
    SceneSpec scene = smallScene();
    scene.colliders.clear();
    scene.cameras[0].follow = scene.cameras[1].follow = "cloth.a";
    scene.cameras[0].followLag = 0.0;
    scene.cameras[1].followLag = 0.2;
    const auto moved = [&](const std::string& camera, double seconds) {
        scene.picture.camera = camera;
        World world(scene);
        while (world.time() < seconds) (void)world.advance();
        const view::Camera now = world.view(false).camera;
        return glm::dvec3(now.eye) - (camera == "close" ? glm::dvec3(1) : glm::dvec3(9));
    };
    const double g = 9.80665, t = 0.5, lag = 0.2;
    constexpr double drag = 0.3;  // [1/s] of the default material
    EXPECT_NEAR(moved("close", t).y, -g * (t / drag - (1 - std::exp(-drag * t)) / (drag * drag)), 1e-3);
    // Drag takes 0.06 m of the body's way, half as much here. A tick of 1/60 s late at 4.9 m/s less 2.9 m/s.
    EXPECT_NEAR(moved("far", t).y, -g * (0.5 * t * t - lag * t + lag * lag * (1 - std::exp(-t / lag))), 0.05);
    EXPECT_NEAR(moved("far", t).x, 0.0, 1e-6);
}

// A rounded foot has normals that lean down.
TEST(Publish, ABoxOnTheGroundHasASharpFootAndOneAboveItHasNot) {
    const auto leansDown = [](double height) {
        SceneSpec scene = smallScene();
        scene.colliders[0].shape = "box";
        scene.colliders[0].size = {1, 1, 1};
        scene.colliders[0].position = {0, height, 0};
        const view::FrameView view = World(scene).view(false);
        const auto& normals = surface(view, "ball")->geometry->normals;
        return std::any_of(normals.begin(), normals.end(),
                           [](const glm::vec3& n) { return n.y < -0.1F && n.y > -0.9F; });
    };
    EXPECT_FALSE(leansDown(0.5));
    EXPECT_TRUE(leansDown(0.51));
}

// Faces name the vertices 3, 1, 2, 4 of the file first.
TEST(Publish, VerticesOfAMeshAreInTheOrderOfItsFile) {
    auto mesh = std::make_shared<MeshData>();
    mesh->positions = {{3, 0, 0}, {1, 1, 0}, {2, 0, 0}, {4, 1, 0}};
    mesh->numbers = {3, 1, 2, 4};
    mesh->triangles = {{0, 1, 2}, {0, 3, 1}};
    ClothSpec cloth;
    cloth.name = "c";
    cloth.mesh = "c.obj";
    cloth.meshData = mesh;
    SceneSpec scene;
    scene.bodies.add(cloth);
    const view::FrameView view = World(scene).view(false);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(view.surfaces[0].geometry->positions[i].x, 1.0F + static_cast<float>(i));
    EXPECT_EQ(view.surfaces[0].topology->triangles, (std::vector<std::uint32_t>{2, 0, 1, 2, 3, 0}));
}

TEST(Publish, SmoothClothHasFourTrianglesForEachAndSmoothRopesTwoRings) {
    SceneSpec scene = smallScene();
    scene.colliders.clear();  // out of which cloth would be lifted
    const view::FrameView coarse = World(scene).view(false);
    const RopeSpec& rope = scene.bodies.of<RopeSpec>()[0];
    scene.bodies.of<ClothSpec>()[0].finish.smooth = 3;
    scene.picture.smooth = 1;  // in place of that
    const view::FrameView fine = World(scene).view(false);
    const view::Surface &before = *surface(coarse, "cloth.a"), &cloth = *surface(fine, "cloth.a");
    EXPECT_EQ(cloth.topology->triangles.size(), 4 * before.topology->triangles.size());
    EXPECT_EQ(cloth.topology->uv.size(), 81U);
    // A flat cloth stays as it is, its own vertices first: to a rounding of 40 weights.
    for (std::size_t v = 0; v < 25; ++v) {
        EXPECT_LT(glm::length(cloth.geometry->positions[v] - before.geometry->positions[v]), 1e-5F);
        EXPECT_LT(glm::length(cloth.geometry->normals[v] - before.geometry->normals[v]), 1e-4F);
        EXPECT_LT(glm::length(cloth.topology->uv[v] - before.topology->uv[v]), 1e-5F);
    }
    constexpr std::size_t sides = 10, more = 2;
    EXPECT_EQ(surface(fine, "rope.b")->topology->uv.size() - surface(coarse, "rope.b")->topology->uv.size(),
              sides * more * static_cast<std::size_t>(rope.segments));
}

TEST(Publish, UnchangedPartsAreShared) {
    World world(smallScene());
    const view::FrameView first = world.view(false);
    ASSERT_FALSE(world.advance());
    const view::FrameView second = world.view(false);
    EXPECT_EQ(surface(first, "cloth.a")->topology, surface(second, "cloth.a")->topology);
    EXPECT_EQ(surface(first, "cloth.a")->finish, surface(second, "cloth.a")->finish);
    EXPECT_NE(surface(first, "cloth.a")->geometry, surface(second, "cloth.a")->geometry);
    EXPECT_EQ(surface(first, "ball")->geometry, surface(second, "ball")->geometry);
}

TEST(Publish, AMomentAheadGoesOnEvenlyAndChangesNothing) {
    // A ball on its way at 2 m/s and 3 rad/s about the vertical, and a camera between two keys.
    SceneSpec scene = smallScene();
    scene.colliders[0].keys = {{0.0, {0, 1, 0}, {0, 0, 0}, Ease::linear}, {1.0, {2, 1, 0}, {0, 3, 0}, Ease::linear}};
    scene.cameras[0].keys = {{0.0, {1, 1, 1}, {0, 0, 0}, {}, Ease::linear},
                             {1.0, {1, 2, 1}, {0, 0, 0}, {}, Ease::linear}};
    World world(scene);
    for (int i = 0; i < 6; ++i) ASSERT_FALSE(world.advance());
    const std::uint64_t before = world.stateHash();
    const double t = world.time();
    for (const double ahead : {-0.004, 0.0, 0.004}) {
        const view::FrameView view = world.viewAhead(ahead);
        EXPECT_NEAR(view.camera.eye.y, 1.0 + t + ahead, 1e-6);
        const glm::mat4& pose = surface(view, "ball")->transform;
        EXPECT_NEAR(pose[3].x, 2.0 * (t + ahead), 1e-6);
        // Of the turn, the chord of a tick is led on: off by less than the cube of the 0.05 rad of a tick.
        EXPECT_NEAR(std::atan2(pose[0].z, pose[0].x), -3.0 * (t + ahead), 1.5e-4);
    }
    EXPECT_EQ(world.stateHash(), before);
    EXPECT_EQ(surface(world.viewAhead(0.0), "cloth.a")->geometry->positions,
              surface(world.view(false), "cloth.a")->geometry->positions);
}

TEST(Publish, TheNamedCameraIsUsed) {
    SceneSpec scene = smallScene();
    EXPECT_EQ(World(scene).view(false).camera.eye.x, 1.0F);
    scene.picture.camera = "far";
    EXPECT_EQ(World(scene).view(false).camera.eye.x, 9.0F);
}

TEST(Publish, TheDebugViewShowsSpringsPointsAndContacts) {
    SceneSpec scene = smallScene();
    scene.bodies.of<ClothSpec>()[0].origin = {-0.5, 1.31, -0.5};
    scene.bodies.of<ClothSpec>()[0].down = {0, 0, 1};
    World world(scene);
    for (int i = 0; i < 10; ++i) ASSERT_FALSE(world.advance());
    const view::FrameView view = world.view(true);
    EXPECT_TRUE(view.showMarks);
    EXPECT_EQ(view.marks.lines.size(), 40U + 32U + 10U);  // structural and shear of the cloth, the rope's segments
    EXPECT_EQ(view.marks.dots.size(), 25U + 11U + static_cast<std::size_t>(world.metrics().contacts));
    EXPECT_GT(world.metrics().contacts, 0);
}

// IEC 61966-2-1: the published pairs of the sRGB curve.
TEST(Publish, ColoursBecomeLinear) {
    EXPECT_NEAR(linearColour({0.5, 0.04045, 1.0}).x, 0.21404F, 1e-5F);
    EXPECT_NEAR(linearColour({0.5, 0.04045, 1.0}).y, 0.0031308F, 1e-6F);
    EXPECT_EQ(linearColour({0.5, 0.04045, 1.0}).z, 1.0F);
}

TEST(Publish, APatternLiesAlongTheEdgesOfATurnedBlock) {
    const auto spread = [](dvec3 rotation) {
        SceneSpec scene;
        BlockSpec spec;
        spec.name = "b";
        spec.size = {0.4, 0.4, 0.4};
        spec.rotation = rotation;
        scene.bodies.add(spec);
        const view::FrameView view = World(scene).view(false);
        glm::vec2 low(1e9F), high(-1e9F);
        for (const glm::vec2& uv : surface(view, "block.b")->topology->uv) {
            low = glm::min(low, uv);
            high = glm::max(high, uv);
        }
        return high - low;
    };
    EXPECT_NEAR(spread({0.0, 0.0, 0.0}).x, 0.4F, 1e-6F);
    EXPECT_NEAR(spread({0.5, 0.6, 0.7}).x, 0.4F, 1e-6F);
    EXPECT_NEAR(spread({0.5, 0.6, 0.7}).y, 0.4F, 1e-6F);
}

TEST(Publish, APictureStandsUprightOnAGridOfCloth) {
    SceneSpec scene;
    scene.bodies.add(support::cloth("a", 4));
    const view::FrameView view = World(scene).view(false);
    const view::Surface& cloth = *surface(view, "cloth.a");
    for (std::size_t i = 0; i < cloth.geometry->positions.size(); ++i)  // v grows upwards, as positions do
        EXPECT_NEAR(cloth.topology->uv[i].y, cloth.geometry->positions[i].y - 2.0F, 1e-6F);
}

TEST(Publish, ABlockShowsSixSidesWithEdges) {
    SceneSpec scene;
    BlockSpec spec;
    spec.name = "b";
    spec.cells = {2, 3, 4};
    scene.bodies.add(spec);
    const view::FrameView view = World(scene).view(false);
    const view::Surface& block = *surface(view, "block.b");
    const std::size_t faces = 2 * (2 * 3 + 3 * 4 + 2 * 4);
    EXPECT_EQ(block.topology->triangles.size(), 3 * 2 * faces);
    EXPECT_EQ(block.geometry->positions.size(), 2U * (3 * 4 + 4 * 5 + 3 * 5));
    for (const glm::vec3& n : block.geometry->normals)  // at rest each points along an axis
        EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1.0F, 1e-6F);
}

}  // namespace
}  // namespace taut::world
