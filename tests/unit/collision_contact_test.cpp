// One point against one shape: rest, penetration, friction, restitution, in both precisions.
#include <gtest/gtest.h>

#include <cstring>

#include "collision_support.h"

namespace taut::collision {
namespace {

struct Case {
    std::string name;
    SizedShape shape;
    double top;  // [m] height of the surface under a point above (0.02, ·, 0.01)
};

std::vector<Case> everyShape() {
    const double rho = std::sqrt(0.02 * 0.02 + 0.01 * 0.01);
    std::vector<Case> cases = {
        {"plane", planeShape(), 0.0},
        {"box", boxShape({0.5, 0.3, 0.4}), 0.3},
        {"sphere", roundShape("sphere", 0.5), std::sqrt(0.25 - rho * rho)},
        {"capsule", roundShape("capsule", 0.2, 0.6), 0.3 + std::sqrt(0.04 - rho * rho)},
        {"cylinder", roundShape("cylinder", 0.3, 0.8), 0.4},
        {"cone", roundShape("cone", 0.4, 0.8), 0.4 - 2.0 * rho},
        {"hull", boxHull({0.5, 0.3, 0.4}), 0.3},
        {"mesh", boxMesh({0.5, 0.3, 0.4}), 0.3},
        {"compound", compoundOf(boxShape({0.5, 0.3, 0.4})), 0.3},
    };
    return cases;
}

template <class Real>
class CollisionContact : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(CollisionContact, Precisions);

TYPED_TEST(CollisionContact, PointComesToRestAtItsThicknessOnEveryShape) {
    // Friction 3 holds it where it lands, on the cone's side (tan α = 2) as well.
    constexpr double h = 1e-3;
    for (const Case& c : everyShape()) {
        SCOPED_TRACE(c.name);
        Colliders colliders;
        colliders.add(c.shape, {3.0, 0.0}, {});
        Flyer<TypeParam> point({0.02, c.top + 0.05, 0.01});
        point.thickness = 0.01;
        for (int i = 0; i < 2000; ++i) point.step(colliders, h, {0.0, -gravity, 0.0});
        // Float: the skin of 4.8e-7 a metre, over coordinates that add up to less than 1. Double: friction undoes
        // a way δ along the tangent, which leaves a round surface by δ² / 2R; with δ up to g h² that is 2.4e-10.
        const double tolerance = isFloat<TypeParam> ? 1e-6 : 2.4e-10;
        EXPECT_NEAR(colliders.distance(point.position()), 0.01, tolerance);
        EXPECT_LT(glm::length(point.velocity()), tolerance);
        ASSERT_EQ(point.contacts.size(), 1U);
        EXPECT_NEAR(point.contacts[0].impulse, gravity * h * point.contacts[0].normal.y, 1e-7);  // float's v
        EXPECT_NEAR(colliders.distance(point.contacts[0].position), 0.0, 2.0 * tolerance);
    }
}

TYPED_TEST(CollisionContact, PointAtRestStaysToTheBit) {
    for (const Case& c : everyShape()) {
        SCOPED_TRACE(c.name);
        Colliders colliders;
        colliders.add(c.shape, {3.0, 0.0}, {});
        Flyer<TypeParam> point({0.02, c.top + 0.012, 0.01});
        point.thickness = 0.01;
        for (int i = 0; i < 1000; ++i) point.step(colliders, 1e-3, {0.0, -gravity, 0.0});
        TypeParam landed[3];
        std::memcpy(landed, point.x, sizeof landed);
        for (int i = 0; i < 1000; ++i) point.step(colliders, 1e-3, {0.0, -gravity, 0.0});
        EXPECT_EQ(std::memcmp(landed, point.x, sizeof landed), 0);
    }
}

TYPED_TEST(CollisionContact, PointSpawnedInsideGoesTheShortestWayOutWithoutSpeed) {
    for (const Case& c : everyShape()) {
        SCOPED_TRACE(c.name);
        Colliders colliders;
        colliders.add(c.shape, {}, {});
        const glm::dvec3 start(0.02, c.top - 0.05, 0.01);
        const double depth = -colliders.distance(start);
        Flyer<TypeParam> point(start);
        point.thickness = 0.01;
        point.step(colliders, 1e-3);
        EXPECT_NEAR(colliders.distance(point.position()), 0.01, 1e-6);  // float's rounding
        EXPECT_NEAR(glm::length(point.position() - start), depth + 0.01, 1e-6);
        EXPECT_EQ(glm::length(point.velocity()), 0.0);
    }
}

// The speed that fields add in two steps; at rest a point arrives with half of it.
TYPED_TEST(CollisionContact, BouncesFromTwiceTheSpeedThatAStepOfTheGravityThereGives) {
    Colliders colliders;
    colliders.add(planeShape(), {0.0, 0.5}, {});
    for (double fall : {0.0, 9.81, 25.0, 200.0})
        for (double share : {0.99, 1.01}) {
            const double h = 1e-3, speed = share * 2.0 * fall * h + (fall > 0 ? 0.0 : 1e-6);
            Flyer<TypeParam> point({0.0, 0.0, 0.0}, {0.0, -speed, 0.0});
            point.fall = fall;
            point.step(colliders, h);
            const bool bounces = share > 1.0 || fall == 0.0;
            EXPECT_NEAR(point.velocity().y, bounces ? 0.5 * speed : 0.0, 1e-6 * speed) << fall << " m/s²";
        }
}

TYPED_TEST(CollisionContact, ArrivingPointLosesItsNormalSpeedOnly) {
    for (const Case& c : everyShape()) {
        SCOPED_TRACE(c.name);
        Colliders colliders;
        colliders.add(c.shape, {0.0, 0.0}, {});
        Flyer<TypeParam> point({0.02, c.top + 0.005, 0.01}, {1.0, -8.0, 0.5});
        point.step(colliders, 1e-3);
        ASSERT_EQ(point.contacts.size(), 1U);
        const glm::dvec3 n = point.contacts[0].normal;
        EXPECT_NEAR(glm::length(n), 1.0, 1e-14);
        EXPECT_GT(n.y, 0.4);
        const glm::dvec3 v(1.0, -8.0, 0.5);
        const glm::dvec3 expected = v - glm::dot(v, n) * n;
        EXPECT_LT(glm::length(point.velocity() - expected), 1e-6);  // float's v
        EXPECT_NEAR(point.contacts[0].impulse, -glm::dot(v, n), 1e-12);
    }
}

TYPED_TEST(CollisionContact, HeldPointIsUnmovedToTheBit) {
    for (const Case& c : everyShape()) {
        Colliders colliders;
        colliders.add(c.shape, {}, {});
        Flyer<TypeParam> point({0.02, c.top - 0.05, 0.01}, {1.0, -2.0, 3.0});
        point.inverseMass = 0;
        const Flyer<TypeParam> was = point;
        point.resolve(colliders, 1e-3);
        EXPECT_EQ(std::memcmp(was.x, point.x, sizeof was.x), 0) << c.name;
        EXPECT_EQ(std::memcmp(was.v, point.v, sizeof was.v), 0) << c.name;
        EXPECT_TRUE(point.contacts.empty()) << c.name;
    }
}

TYPED_TEST(CollisionContact, PointThatIsNoNumberIsLeftAlone) {
    for (const Case& c : everyShape()) {
        Colliders colliders;
        colliders.add(c.shape, {}, {});
        for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
            Flyer<TypeParam> point({0.02, c.top - 0.05, 0.01});
            point.x[1] = static_cast<TypeParam>(bad);
            point.resolve(colliders, 1e-3);
            EXPECT_FALSE(std::isfinite(point.x[1])) << c.name;
            EXPECT_EQ(point.x[0], static_cast<TypeParam>(0.02)) << c.name;
        }
    }
}

// A slope through the origin, falling towards +x, as a plane, as a turned box, as a mesh and as a hull.
std::vector<Colliders> slopes(double angle, double friction) {
    std::vector<Colliders> all(4);
    const Pose pose{{0.0, 0.0, 0.0}, turned({0.0, 0.0, 1.0}, -angle)};
    const glm::dvec3 normal = pose.rotation * glm::dvec3(0.0, 1.0, 0.0);
    const Pose under{-0.5 * normal, pose.rotation};
    all[0].add(planeShape(), {friction, 0.0}, pose);
    all[1].add(boxShape({50.0, 0.5, 1.0}), {friction, 0.0}, under);
    all[2].add(sheetMesh(40.0, 40), {friction, 0.0}, pose);
    all[3].add(boxHull({50.0, 0.5, 1.0}), {friction, 0.0}, under);
    return all;
}

TYPED_TEST(CollisionContact, FrictionHoldsAPointOnASlopeWithoutCreep) {
    // tan α = 0.577 < μ = 0.6. Ten seconds; only the landing may pass, of half a float step at most.
    for (const double h : {1e-2, 1e-3, 1e-4}) {
        for (const Colliders& slope : slopes(core::radians(30.0), 0.6)) {
            const glm::dvec3 along(core::cosine(core::radians(30.0)), -0.5, 0.0);
            const glm::dvec3 start = 0.7 * along + 0.005 * glm::dvec3(0.5, core::cosine(core::radians(30.0)), 0.0);
            Flyer<TypeParam> point(start);
            point.thickness = 0.005;
            for (int i = 0; i < static_cast<int>(std::lround(10.0 / h)); ++i)
                point.step(slope, h, {0.0, -gravity, 0.0});
            EXPECT_LT(glm::length(point.position() - start), isFloat<TypeParam> ? 1e-6 : 1e-12) << h;
        }
    }
}

TYPED_TEST(CollisionContact, PointSlidesDownASlopeThatIsTooSteep) {
    // a = g (sin α - μ cos α); after n steps of symplectic Euler from rest x = a h² n (n + 1) / 2 exactly. Double:
    // rounding over 1000 steps. Float: each step rounds x to 6e-8 a metre, in the worst case always the same way.
    constexpr double h = 1e-3;
    constexpr int n = 1000;
    const double angle = core::radians(35.0);
    const double mu = 0.6;
    const double a = gravity * (core::sine(angle) - mu * core::cosine(angle));
    const double expected = 0.5 * a * h * h * n * (n + 1);
    for (const Colliders& slope : slopes(angle, mu)) {
        Flyer<TypeParam> point({0.005 * core::sine(angle), 0.005 * core::cosine(angle), 0.1});
        const glm::dvec3 start = point.position();
        point.thickness = 0.005;
        for (int i = 0; i < n; ++i) point.step(slope, h, {0.0, -gravity, 0.0});
        const double way = glm::length(point.position() - start);
        EXPECT_NEAR(way, expected, isFloat<TypeParam> ? 1e-4 : 1e-11);
        EXPECT_NEAR(glm::length(point.velocity()), a * h * n, isFloat<TypeParam> ? 1e-4 : 1e-11);
    }
}

TYPED_TEST(CollisionContact, FrictionDecidesBetweenHoldingAndSlidingAtTanAlpha) {
    const double angle = core::radians(20.0);
    const double tangent = core::sine(angle) / core::cosine(angle);
    for (const double factor : {0.99, 1.01}) {
        for (const Colliders& slope : slopes(angle, factor * tangent)) {
            Flyer<TypeParam> point({0.0, 0.0, 0.1});
            const glm::dvec3 start = point.position();
            for (int i = 0; i < 2000; ++i) point.step(slope, 1e-3, {0.0, -gravity, 0.0});
            // Two seconds of 0.01 g sin α are 67 mm.
            if (factor < 1.0)
                EXPECT_GT(glm::length(point.position() - start), 0.05);
            else
                EXPECT_LT(glm::length(point.position() - start), 5e-6);  // the skin of a sheet without thickness
        }
    }
}

TYPED_TEST(CollisionContact, BounceHeightsFallByTheSquareOfTheRestitution) {
    constexpr double h = 1e-4;
    for (const double e : {0.5, 0.8, 1.0}) {
        Colliders colliders;
        colliders.add(planeShape(), {0.3, e}, {});
        Flyer<TypeParam> point({0.0, 1.0, 0.0});
        double top = 0.0;
        std::vector<double> tops;
        for (int i = 0; i < 40000 && tops.size() < 4; ++i) {
            point.step(colliders, h, {0.0, -gravity, 0.0});
            if (!point.contacts.empty()) {
                if (top > 0.0) tops.push_back(top);
                top = 0.0;
            }
            if (point.v[1] > 0) top = std::max(top, static_cast<double>(point.x[1]));
        }
        // The instant of an impact is known to within a step: speeds are off by up to g h of each impact speed
        // √(2 g H), so the height of bounce n by a relative 2 g h / √(2 g H) for each bounce before. In float the
        // 2000 steps of a flight add 6e-8 m of rounding each, in the worst case 1e-4 m.
        double height = 1.0;
        double tolerance = 0.0;
        for (const double measured : tops) {
            tolerance = tolerance * e * e + 2.0 * gravity * h / std::sqrt(2.0 * gravity * height) * height;
            height *= e * e;
            EXPECT_NEAR(measured, height, tolerance + (isFloat<TypeParam> ? 1e-4 : 0.0)) << e;
        }
        ASSERT_GE(tops.size(), 3U);
    }
}

TYPED_TEST(CollisionContact, BouncingPointComesToRest) {
    constexpr double h = 1e-3;
    Colliders colliders;
    colliders.add(planeShape(), {0.3, 0.9}, {});
    Flyer<TypeParam> point({0.0, 0.2, 0.0});
    for (int i = 0; i < 10000; ++i) point.step(colliders, h, {0.0, -gravity, 0.0});
    EXPECT_NEAR(static_cast<double>(point.x[1]), 0.0, 1e-6);
    EXPECT_NEAR(static_cast<double>(point.v[1]), 0.0, 1e-7);
}

TYPED_TEST(CollisionContact, PointSlidesOverInnerEdgesOfAMeshWithoutCatching) {
    Colliders colliders;
    colliders.add(sheetMesh(2.0, 40), {0.0, 0.0}, {});
    for (const double thickness : {0.0, 0.004}) {
        Flyer<TypeParam> point({-1.0, 0.004, 0.03}, {2.0, 0.0, 0.11});
        point.thickness = thickness;
        for (int i = 0; i < 900; ++i) {
            point.step(colliders, 1e-3, {0.0, -gravity, 0.0});
            ASSERT_NEAR(static_cast<double>(point.v[0]), 2.0, 1e-5) << i;  // rounding of a normal, 900 times
            ASSERT_GT(static_cast<double>(point.x[1]), 0.0) << i;
        }
        EXPECT_NEAR(static_cast<double>(point.x[0]), 0.8, 1e-4);
    }
}

}  // namespace
}  // namespace taut::collision
