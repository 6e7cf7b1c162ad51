// A shape from outside the engine: a torus about y, which is not convex. Its form gives no more than its distance.
#include <gtest/gtest.h>

#include <cmath>

#include "collision_support.h"
#include "support/small_scenes.h"
#include "taut/bodies/rope.h"
#include "taut/core/rigid_motion.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::world::own_shape {
namespace {

using collision::Flyer;
using collision::Nearest;

// How far p is from a tube of radius r whose middle is the circle of radius R in y = 0.
class Torus final : public collision::Form {
  public:
    Torus(double ring, double tube) : ring_(ring), tube_(tube) {}
    Nearest nearest(const dvec3& p) const override {
        const double rho = std::sqrt(p.x * p.x + p.z * p.z);
        const dvec3 out = rho > 0.0 ? dvec3(p.x / rho, 0.0, p.z / rho) : dvec3(1.0, 0.0, 0.0);
        const dvec3 apart = p - ring_ * out;
        const double d = std::sqrt(glm::dot(apart, apart));
        return {d - tube_, d > 0.0 ? apart / d : dvec3(0.0, 1.0, 0.0)};
    }
    std::optional<core::Aabb> bounds() const override {
        const dvec3 half(ring_ + tube_, tube_, ring_ + tube_);
        return core::Aabb{-half, half};
    }

  private:
    double ring_, tube_;
};

view::Mesh meshOfTorus(const collision::ShapeSizes& sizes) {
    constexpr int around = 24, across = 12;
    constexpr double turn = 2.0 * core::pi;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;
    for (int i = 0; i < around; ++i)
        for (int k = 0; k < across; ++k) {
            const double a = turn * i / around, b = turn * k / across;
            const double rho = sizes.radius + sizes.own.at("tube_m") * std::cos(b);
            positions.emplace_back(rho * std::cos(a), sizes.own.at("tube_m") * std::sin(b), rho * std::sin(a));
            const auto at = [](int row, int column) {
                return static_cast<std::uint32_t>(row % around * across + column % across);
            };
            for (std::uint32_t corner :
                 {at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i + 1, k)})
                triangles.push_back(corner);
        }
    return view::creasedMesh(positions, triangles, 1.0F);
}

// Its mass: V = 2π²R r², and about the axis V (R² + 3/4 r²).
collision::SolidShape solidTorus(const collision::ShapeSizes& sizes, double) {
    const view::Mesh mesh = meshOfTorus(sizes);
    const double ring = sizes.radius, tube = sizes.own.at("tube_m");
    const double volume = 2.0 * core::pi * core::pi * ring * tube * tube;
    const double across = 0.5 * volume * (ring * ring + 0.75 * tube * tube), along = 0.25 * volume * tube * tube;
    collision::SolidShape solid;
    for (const glm::vec3& x : mesh.geometry->positions) solid.positions.emplace_back(x);
    const std::vector<std::uint32_t>& corners = mesh.topology->triangles;
    for (std::size_t k = 0; k < corners.size(); k += 3)
        solid.triangles.push_back(
            {static_cast<int>(corners[k]), static_cast<int>(corners[k + 1]), static_cast<int>(corners[k + 2])});
    solid.properties = {volume, dvec3(0.0), glm::dmat3(across, 0, 0, 0, along, 0, 0, 0, across)};
    return solid;
}

std::shared_ptr<const collision::ShapeKinds> withTorus() {
    collision::ShapeKinds kinds = collision::builtInShapes();
    kinds.add({.name = "torus",
               .fields = {"radius"},
               .own = {{"tube_m", "m", 1e-3, 10.0, 0.125, "Radius of the tube."}},
               .form =
                   [](const collision::ShapeSizes& sizes) {
                       return std::make_shared<Torus>(sizes.radius, sizes.own.at("tube_m"));
                   },
               .mesh = meshOfTorus,
               .solid = solidTorus});
    return std::make_shared<const collision::ShapeKinds>(std::move(kinds));
}

// Ring 0.5 m, tube 0.125 m.
collision::Colliders torus(const collision::Pose& pose = {}) {
    collision::ShapeSizes sizes;
    sizes.radius = 0.5;
    sizes.own["tube_m"] = 0.125;
    collision::Colliders colliders;
    colliders.add(withTorus()->find("torus")->shape(sizes), {2.0, 0.0}, pose);
    return colliders;
}

TEST(OwnShape, HasTheDistanceToTheNearestOfItsCircles) {
    const collision::Pose pose{{0.1, 0.2, 0.3}, collision::turned({1.0, 2.0, 3.0}, 0.7)};
    const collision::Colliders colliders = torus(pose);
    collision::Numbers numbers;
    for (int i = 0; i < 200; ++i) {
        const dvec3 p = numbers.point(1.0);
        double exact = 1e300;
        for (int k = 0; k < 4000; ++k) {
            const double a = 2.0 * core::pi * k / 4000;
            const dvec3 centre = pose.position + pose.rotation * dvec3(0.5 * std::cos(a), 0.0, 0.5 * std::sin(a));
            exact = std::min(exact, glm::length(p - centre) - 0.125);
        }
        // One of 4000 centres lies within s = 4e-4 m of the nearest one: at most (s²/2)(1/d + 1/R) too far.
        EXPECT_NEAR(colliders.distance(p), exact, 8e-8 * (1.0 / (exact + 0.125) + 1.0 / 0.5)) << i;
    }
}

TEST(OwnShape, LetsPointsThroughItsHoleAndNotThroughItsTube) {
    const collision::Colliders colliders = torus();
    const double h = 0.01;
    Flyer<double> through({0.0, 1.0, 0.0}, {0.0, -200.0, 0.0});
    through.step(colliders, h);
    EXPECT_DOUBLE_EQ(through.x[1], -1.0);
    EXPECT_TRUE(through.contacts.empty());
    // From above through the tube; from outside through one side of the tube to the hole, and to beyond both.
    struct Throw {
        dvec3 from, to, stopped;
    };
    for (const Throw& thrown : {Throw{{0.5, 1.0, 0.0}, {0.5, -1.0, 0.0}, {0.5, 0.135, 0.0}},
                                Throw{{-2.0, 0.0, 0.0}, {0.25, 0.0, 0.0}, {-0.635, 0.0, 0.0}},
                                Throw{{-2.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {-0.635, 0.0, 0.0}}}) {
        Flyer<double> point(thrown.from, (thrown.to - thrown.from) / h);
        point.thickness = 0.01;
        point.step(colliders, h);
        EXPECT_EQ(point.contacts.size(), 1U);
        EXPECT_LT(glm::length(point.position() - thrown.stopped), 1e-9);  // as near as the search comes
    }
}

TEST(OwnShape, BearsAPointThatRestsOnIt) {
    const collision::Colliders colliders = torus();
    Flyer<double> point({0.5, 0.2, 0.0});
    point.thickness = 0.01;
    for (int i = 0; i < 200; ++i) point.step(colliders, 0.005, {0.0, -collision::gravity, 0.0});
    EXPECT_NEAR(point.x[1], 0.135, 1e-12);  // rounding
    EXPECT_NEAR(point.v[1], 0.0, 1e-12);
}

TEST(OwnShape, IsSeenAndFeltInAWorld) {
    SceneSpec scene;
    scene.colliders = {support::ball("ring", {0.0, 1.0, 0.0}, 0.5)};
    scene.colliders[0].shape = "torus";
    scene.bodies.add(support::rope("line", {-0.8, 1.2, 0.0}, {0.8, 1.2, 0.0}, 40));
    EXPECT_THROW(World{scene}, core::Error);
    scene.shapes = withTorus();
    World world(scene);
    const view::FrameView view = world.view(false);
    ASSERT_EQ(view.surfaces.size(), 2U);
    const view::Surface& ring = view.surfaces[0];
    EXPECT_EQ(ring.name, "ring");
    EXPECT_EQ(ring.transform[3].y, 1.0F);
    ASSERT_GE(ring.geometry->positions.size(), 24U * 12U);
    for (const glm::vec3& x : ring.geometry->positions)
        EXPECT_NEAR(Torus(0.5, 0.125).nearest(x).distance, 0.0, 1e-7);  // rounding to float
    // Across both sides of the ring, above which it falls 7 cm.
    for (int i = 0; i < 20; ++i) ASSERT_FALSE(world.advance());
    EXPECT_GT(world.metrics().contacts, 1);
    EXPECT_LT(world.metrics().penetration, 1e-6);  // rounding of a state in float
}

TEST(OwnShape, StandsInASceneWithASizeOfItsOwn) {
    scene::LoadOptions options;
    Kinds kinds = builtIn();
    kinds.shapes = *withTorus();
    options.kinds = std::make_shared<const Kinds>(kinds);
    const std::string text =
        "schema = 1\ncollider.ring = { shape = \"torus\", radius = 0.5, tube_m = 0.25 }\n"
        "[rope.line]\nends = [[0, 2, 0], [1, 2, 0]]\n";
    const SceneSpec scene = scene::loadSceneText(text, "s.toml", options).spec;
    EXPECT_EQ(scene.colliders[0].sizes.at("tube_m"), 0.25);
    EXPECT_NO_THROW(World{scene});
    EXPECT_NE(scene::jsonSchema(kinds).find("Radius of the tube. [m]"), std::string::npos);
    EXPECT_THROW(scene::loadSceneText(text, "s.toml", {}), core::Error);
}

// Two rings lie on the ground and on a ring that is a collider, one of them a part of a compound.
TEST(OwnShape, IsASolidAndAPartOfOne) {
    scene::LoadOptions options;
    Kinds kinds = builtIn();
    kinds.shapes = *withTorus();
    options.kinds = std::make_shared<const Kinds>(kinds);
    const std::string text =
        "schema = 1\ncollider.ground = { shape = \"plane\" }\n"
        "collider.ring = { shape = \"torus\", radius = 0.5, tube_m = 0.125, position = [2, 0.125, 0] }\n"
        "[solid.low]\nshape = \"torus\"\nradius = 0.5\ntube_m = 0.1\nposition = [0, 0.11, 0]\n"
        "density_kg_per_m3 = 100\n"
        "[solid.high]\nshape = \"compound\"\nposition = [2, 0.36, 0]\n"
        "parts = [{ shape = \"torus\", radius = 0.5, tube_m = 0.1 }]\n";
    const SceneSpec scene = scene::loadSceneText(text, "s.toml", options).spec;
    World world(scene);
    const double volume = 2 * core::pi * core::pi * 0.5 * 0.01;
    const auto motionOf = [&](const char* name) {
        const PointsNow points = world.points(name);
        return core::rigidMotionOf(points.mass, points.x, points.v);
    };
    const core::RigidMotion low = motionOf("solid.low");
    EXPECT_NEAR(low.mass / (100 * volume), 1.0, 1e-12);
    EXPECT_NEAR(low.inverseInertia[1][1] * 100 * volume * (0.25 + 0.75 * 0.01), 1.0, 1e-7);  // the corners are floats
    for (int i = 0; i < 60; ++i) ASSERT_FALSE(world.advance());
    // Meshes rest within a tenth of their thickness.
    EXPECT_NEAR(motionOf("solid.low").centre.y, 0.102, 2e-4);
    EXPECT_NEAR(motionOf("solid.high").centre.y, 0.352, 2e-4);
    EXPECT_THROW(scene::loadSceneText(text, "s.toml", {}), core::Error);
    SceneSpec unknown = scene;
    unknown.shapes = nullptr;
    EXPECT_THROW(World{unknown}, core::Error);
}

}  // namespace
}  // namespace taut::world::own_shape
