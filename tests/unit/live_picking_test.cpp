#include "taut/live/picking.h"

#include <gtest/gtest.h>

#include "taut/live/orbit.h"
#include "taut/view/camera_axes.h"

namespace taut::live {
namespace {

view::Camera ahead() {
    view::Camera camera;
    camera.eye = {0.0F, 0.0F, 5.0F};
    camera.target = {0.0F, 0.0F, 0.0F};
    return camera;
}

// Two triangles in the plane z, from -1 to 1.
view::Surface square(const std::string& name, float z) {
    view::Topology topology;
    topology.triangles = {0, 1, 2, 0, 2, 3};
    view::Geometry geometry;
    geometry.positions = {{-1.0F, -1.0F, z}, {1.0F, -1.0F, z}, {1.0F, 1.0F, z}, {-1.0F, 1.0F, z}};
    view::Surface surface;
    surface.name = name;
    surface.topology = std::make_shared<const view::Topology>(std::move(topology));
    surface.geometry = std::make_shared<const view::Geometry>(std::move(geometry));
    return surface;
}

BodyPoints corners(const std::string& name, double z) {
    return {name, {0, 1, 2, 3}, {{-1.0, -1.0, z}, {1.0, -1.0, z}, {1.0, 1.0, z}, {-1.0, 1.0, z}}};
}

TEST(Picking, TheRayThroughTheMiddleLooksAhead) {
    const Ray ray = rayThrough(ahead(), {0.5, 0.5}, 16.0 / 9.0);
    EXPECT_NEAR(ray.along.x, 0.0, 1e-7);  // a camera has floats
    EXPECT_NEAR(ray.along.y, 0.0, 1e-7);
    EXPECT_NEAR(ray.along.z, -1.0, 1e-7);
}

// tan of half the angle, times the distance, is half the visible height.
TEST(Picking, TheUpperEdgeIsHalfTheAngleOfView) {
    const Ray ray = rayThrough(ahead(), {0.5, 0.0}, 16.0 / 9.0);
    EXPECT_NEAR(ray.along.y / -ray.along.z, std::tan(0.35), 1e-6);  // 0.7 rad, a float
}

TEST(Picking, APlaceIsSeenWhereTheRayThroughItGoes) {
    view::Camera camera = ahead();
    camera.eye = {1.0F, 2.0F, 5.0F};
    for (const glm::dvec2 place : {glm::dvec2(0.1, 0.2), glm::dvec2(0.5, 0.5), glm::dvec2(1.3, 0.9)}) {
        const Ray ray = rayThrough(camera, place, 1.5);
        const auto at = seenAt(camera, ray.from + 3.0 * ray.along, 1.5);
        ASSERT_TRUE(at);
        EXPECT_NEAR(at->x, place.x, 1e-6);  // a camera has floats
        EXPECT_NEAR(at->y, place.y, 1e-6);
        EXPECT_FALSE(seenAt(camera, ray.from - ray.along, 1.5));
    }
}

// The left and right edges of 16:9 are at the edges of an upright picture too, as drawing has it.
TEST(Picking, UprightPicturesAreAsWideAs16To9) {
    const view::Camera camera = ahead();
    for (const double x : {0.001, 0.5, 0.999}) {
        const Ray ray = rayThrough(camera, {x, 0.5}, 16.0 / 9.0);
        for (const double aspect : {390.0 / 780.0, 405.0 / 720.0, 4.0 / 3.0, 16.0 / 9.0, 2.4}) {
            const glm::dvec3 place = ray.from + 3.0 * ray.along + glm::dvec3(0.0, 0.3, 0.0);
            const auto at = seenAt(camera, place, aspect);
            ASSERT_TRUE(at);
            const double share = std::min(16.0 / 9.0 / aspect, 1.0);      // of a wider picture
            EXPECT_NEAR(at->x, 0.5 + (x - 0.5) * share, 1e-6) << aspect;  // a camera has floats
            const glm::vec4 clip = projectionOf(camera, static_cast<float>(aspect)) * glm::vec4(place, 1.0F);
            EXPECT_NEAR(at->x, 0.5 + 0.5 * static_cast<double>(clip.x / clip.w), 1e-6) << aspect;
            EXPECT_NEAR(at->y, 0.5 - 0.5 * static_cast<double>(clip.y / clip.w), 1e-6) << aspect;
        }
    }
}

TEST(Picking, TakesThePointNearestToWhereTheBodyIsMet) {
    const std::vector<view::Surface> surfaces = {square("cloth.a", 0.0F)};
    const std::vector<BodyPoints> bodies = {corners("cloth.a", 0.0)};
    // (0.55, 0.6) of half the height 5 tan 0.35: the upper right quarter.
    const auto picked = pick(rayThrough(ahead(), {0.6, 0.35}, 1.0), surfaces, bodies, 0.01);
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->body, "cloth.a");
    EXPECT_EQ(picked->point, 2);
}

TEST(Picking, TheBodyInFrontIsTaken) {
    const std::vector<view::Surface> surfaces = {square("cloth.far", -1.0F), square("cloth.near", 1.0F)};
    const std::vector<BodyPoints> bodies = {corners("cloth.far", -1.0), corners("cloth.near", 1.0)};
    const auto picked = pick(rayThrough(ahead(), {0.5, 0.45}, 1.0), surfaces, bodies, 0.01);
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->body, "cloth.near");
}

TEST(Picking, AColliderHidesWhatIsBehindIt) {
    const std::vector<view::Surface> surfaces = {square("cloth.a", 0.0F), square("wall", 1.0F)};
    const std::vector<BodyPoints> bodies = {corners("cloth.a", 0.0)};
    EXPECT_FALSE(pick(rayThrough(ahead(), {0.5, 0.45}, 1.0), surfaces, bodies, 0.01));
}

TEST(Picking, APointBesideTheRayIsTakenWithinReachOnly) {
    const std::vector<BodyPoints> bodies = {{"rope.a", {7}, {{0.1, 0.0, 0.0}}}};  // 0.02 m for each metre of distance
    const Ray ray = rayThrough(ahead(), {0.5, 0.5}, 1.0);
    EXPECT_FALSE(pick(ray, {}, bodies, 0.015));
    const auto picked = pick(ray, {}, bodies, 0.025);
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->point, 7);
}

TEST(Picking, DraggingStaysInThePlaneOfThePicture) {
    const glm::dvec3 place = onPicturePlane(rayThrough(ahead(), {0.9, 0.2}, 16.0 / 9.0), ahead(), {0.3, 0.1, 1.5});
    EXPECT_NEAR(place.z, 1.5, 1e-6);  // a camera has floats
    EXPECT_GT(place.x, 0.3);
    EXPECT_GT(place.y, 0.1);
}

TEST(Orbit, FollowsTheSceneUntilItIsTouched) {
    Orbit orbit;
    view::Camera camera = ahead();
    EXPECT_EQ(orbit.camera(camera).eye, camera.eye);
    orbit.turn(1.5707963267948966, 0.0, camera);            // a quarter to the right: seen from the left
    EXPECT_NEAR(orbit.camera(camera).eye.x, -5.0F, 1e-5F);  // floats
    EXPECT_NEAR(orbit.camera(camera).eye.z, 0.0F, 1e-5F);
    orbit.zoom(0.5, camera);
    EXPECT_NEAR(glm::length(orbit.camera(camera).eye), 2.5F, 1e-5F);
    orbit.follow();
    EXPECT_EQ(orbit.camera(camera).eye, camera.eye);
}

TEST(Orbit, NeverReachesThePole) {
    Orbit orbit;
    for (int i = 0; i < 50; ++i) orbit.turn(0.0, 0.5, ahead());
    const glm::vec3 eye = orbit.camera(ahead()).eye;
    EXPECT_GT(eye.z, 0.0F);
    EXPECT_NEAR(glm::length(eye), 5.0F, 1e-4F);  // floats, fifty times
}

}  // namespace
}  // namespace taut::live
