// Fast points and fast colliders, and points between colliders.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "collision_support.h"

namespace taut::collision {
namespace {

template <class Real>
class CollisionSweep : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(CollisionSweep, Precisions);

// Walls of 1 cm in the plane y = 0, and a sheet without thickness.
std::vector<std::pair<std::string, SizedShape>> walls() {
    const glm::dvec3 half(1.0, 0.005, 1.0);
    return {{"box", boxShape(half)},
            {"hull", boxHull(half)},
            {"mesh", boxMesh(half)},
            {"compound", compoundOf(boxShape(half))},
            {"cylinder", roundShape("cylinder", 1.0, 0.01)},
            {"sheet", sheetMesh(1.0, 9)}};
}

TYPED_TEST(CollisionSweep, PointAt100MetresASecondDoesNotCrossAWallOf1Centimetre) {
    for (const auto& [name, shape] : walls()) {
        Colliders colliders;
        colliders.add(shape, {}, {});
        for (const double h : {1.0 / 60.0, 1.0 / 1000.0}) {
            for (const double thickness : {0.0, 0.004}) {
                for (const double side : {1.0, -1.0}) {
                    // Starts that put the end of a step on either side of the wall and inside it.
                    for (const double start : {0.011, 0.1, 0.105, 0.3, 1.2, 1.667}) {
                        for (const double slant : {0.0, 3.0}) {
                            Flyer<TypeParam> point({0.0, side * start, 0.0}, {slant, -100.0 * side, 0.3 * slant});
                            point.thickness = thickness;
                            for (int i = 0; i < 40; ++i) {
                                point.step(colliders, h);
                                ASSERT_GT(side * static_cast<double>(point.x[1]), 0.0)
                                    << name << " " << h << " " << start;
                            }
                            // Stopped: friction 0.3 of the 100 m/s takes the sideways speed too.
                            EXPECT_NEAR(static_cast<double>(point.v[1]), 0.0, 1e-5) << name;  // float's 100 m/s
                        }
                    }
                }
            }
        }
    }
}

TYPED_TEST(CollisionSweep, PointThatRestsOnAWallIsNotPulledThrough) {
    // At rest it stands within rounding of the surface, on either side of it; then it is torn down.
    for (const auto& [name, shape] : walls()) {
        for (const double thickness : {0.0, 0.004}) {
            Colliders colliders;
            colliders.add(shape, {0.5, 0.0}, {});
            Flyer<TypeParam> point({0.123, 0.03, 0.077});
            point.thickness = thickness;
            for (int i = 0; i < 300; ++i) point.step(colliders, 1e-3, {0.0, -gravity, 0.0});
            point.v[1] = -100;
            point.step(colliders, 1.0 / 60.0);
            EXPECT_NEAR(static_cast<double>(point.x[1]), name == "sheet" ? thickness : 0.005 + thickness, 2e-6) << name;
            EXPECT_NEAR(static_cast<double>(point.v[1]), 0.0, 1e-5) << name;
        }
    }
}

TYPED_TEST(CollisionSweep, GrazingPathThatCutsASphereEndsOutside) {
    Colliders colliders;
    colliders.add(roundShape("sphere", 0.5), {0.0, 0.0}, {});
    Flyer<TypeParam> point({-1.0, 0.45, 0.0}, {100.0, 0.0, 0.0});
    point.step(colliders, 1.0 / 50.0);
    ASSERT_EQ(point.contacts.size(), 1U);
    // It touches at x = -√(0.25 - 0.2025); the normal there is (-0.4359, 0.9, 0).
    EXPECT_NEAR(point.contacts[0].normal.y, 0.9, 1e-6);
    EXPECT_NEAR(static_cast<double>(point.v[1]), 100.0 * std::sqrt(0.19) * 0.9, 1e-4);
    EXPECT_GE(colliders.distance(point.position()), 0.0);
}

TYPED_TEST(CollisionSweep, PathBesideAShapeIsFree) {
    Colliders colliders;
    for (const auto& [name, shape] : walls()) colliders.add(shape, {}, {});
    colliders.add(roundShape("sphere", 0.4), {}, {});
    colliders.add(roundShape("cone", 0.4, 0.8), {}, {});
    Flyer<TypeParam> point({1.1, 1.0, 0.0}, {0.0, -100.0, 0.0});
    point.thickness = 0.05;
    point.step(colliders, 1.0 / 50.0);
    EXPECT_TRUE(point.contacts.empty());
    EXPECT_EQ(point.x[1], static_cast<TypeParam>(1.0) + static_cast<TypeParam>(1.0 / 50.0) * point.v[1]);
}

TYPED_TEST(CollisionSweep, FastColliderPushesAStillPointAheadOfIt) {
    // 50 m/s for 0.1 s; the point takes the collider's speed and stays before it.
    for (const auto& [name, shape] : walls()) {
        for (const double h : {1.0 / 60.0, 1.0 / 1000.0}) {
            Colliders colliders;
            const int wall = colliders.add(shape, {}, {});
            Flyer<TypeParam> point({0.1, 1.0, 0.2});
            point.thickness = 0.004;
            double y = 0.0;
            for (int i = 0; i < static_cast<int>(std::lround(0.1 / h)); ++i) {
                const double next = y + 50.0 * h;
                colliders.move(wall, {.position = {0.0, y, 0.0}}, {.position = {0.0, next, 0.0}});
                point.step(colliders, h);
                y = next;
                ASSERT_GT(static_cast<double>(point.x[1]), y) << name;
            }
            EXPECT_NEAR(static_cast<double>(point.v[1]), 50.0, 1e-4) << name;  // float's rounding of 50
            EXPECT_LT(static_cast<double>(point.x[1]), y + 0.01) << name;
        }
    }
}

TYPED_TEST(CollisionSweep, PointRidesOnAColliderThatCarriesIt) {
    // Friction takes it along a turntable and a lift that runs sideways.
    Colliders colliders;
    const int table = colliders.add(roundShape("cylinder", 1.0, 0.2), {2.0, 0.0}, {});
    Flyer<TypeParam> point({0.5, 0.1, 0.0}, {0.2, 0.0, -0.5});
    const double h = 1e-3;
    Pose pose;
    for (int i = 1; i <= 1000; ++i) {
        const Pose next{{0.2 * i * h, 0.0, 0.0}, turned({0.0, 1.0, 0.0}, 1.0 * i * h)};
        colliders.move(table, pose, next);
        pose = next;
        point.step(colliders, h, {0.0, -gravity, 0.0});
    }
    const glm::dvec3 expected = pose.position + pose.rotation * glm::dvec3(0.5, 0.1, 0.0);
    // It starts with the table's speed along the tangent, the step runs along the chord: ω² r h² / 2 = 2.5e-7 m until
    // friction has it. Float: rounding of 6e-8 a step, 1000 times.
    EXPECT_LT(glm::length(point.position() - expected), isFloat<TypeParam> ? 6e-5 : 2.5e-7);
}

TYPED_TEST(CollisionSweep, JumpingColliderDoesNotAccelerate) {
    // 5 m in a step of 1/1000 s would be 5000 m/s. The point that finds itself inside goes the shortest way out.
    for (const auto& [name, shape] :
         std::vector<std::pair<std::string, SizedShape>>{{"box", boxShape({0.5, 0.3, 0.5})},
                                                         {"hull", boxHull({0.5, 0.3, 0.5})},
                                                         {"mesh", boxMesh({0.5, 0.3, 0.5})}}) {
        Colliders colliders;
        const int box = colliders.add(shape, {}, {{5.0, 0.0, 0.0}});
        Flyer<TypeParam> point({0.0, 0.25, 0.1});
        Flyer<TypeParam> passed({2.5, 0.1, 0.0});
        colliders.move(box, {.position = {5.0, 0.0, 0.0}}, {});
        point.step(colliders, 1e-3);
        passed.step(colliders, 1e-3);
        // Float: a mesh without thickness keeps 8 skins, 8 · 4.8e-7 · 0.35.
        EXPECT_NEAR(static_cast<double>(point.x[1]), 0.3, 1.4e-6) << name;
        EXPECT_EQ(static_cast<double>(point.x[0]), 0.0) << name;
        EXPECT_EQ(glm::length(point.velocity()), 0.0) << name;
        EXPECT_EQ(static_cast<double>(passed.x[0]), 2.5) << name;
    }
}

TYPED_TEST(CollisionSweep, NoPointLeavesAColliderFasterThanTheLimit) {
    // When a collider jumps, spins or flips, the speed that it gives is at most 100 m/s.
    for (const auto& [name, shape] : walls()) {
        Colliders colliders;
        const int wall = colliders.add(shape, {0.8, 1.0}, {});
        Flyer<TypeParam> point({0.2, 0.05, 0.1});
        Pose pose;
        for (int i = 0; i < 200; ++i) {
            const Pose next{{0.0, 0.3 * ((i * 7) % 5 - 2), 0.1 * (i % 3)}, turned({1.0, 0.2, 0.0}, 0.9 * i)};
            colliders.move(wall, pose, next);
            pose = next;
            for (TypeParam& v : point.v) v = 0;
            point.step(colliders, 1.0 / 60.0);
            ASSERT_LT(glm::length(point.velocity()), 200.0 + 1e-3) << name;  // with restitution 1: twice
            ASSERT_LT(glm::length(point.position()), 100.0) << name << i;
        }
    }
}

TYPED_TEST(CollisionSweep, TurningBarSweepsThePointAlong) {
    // A bar turns by 60 degrees in a step; the point lies in the quarter that it sweeps and ends on its far side.
    for (const auto& shape : {boxShape({1.0, 0.02, 0.2}), boxHull({1.0, 0.02, 0.2}), boxMesh({1.0, 0.02, 0.2})}) {
        Colliders colliders;
        const int bar = colliders.add(shape, {0.0, 0.0}, {});
        const Pose end{{0.0, 0.0, 0.0}, turned({0.0, 0.0, 1.0}, core::radians(60.0))};
        colliders.move(bar, {}, end);
        const double angle = core::radians(30.0);
        Flyer<TypeParam> point({0.6 * core::cosine(angle), 0.6 * core::sine(angle), 0.0});
        point.step(colliders, 1.0 / 60.0);
        const glm::dvec3 local = glm::conjugate(end.rotation) * point.position();
        EXPECT_GT(local.y, 0.02 - 1e-6);
        EXPECT_LT(local.y, 0.5);
        ASSERT_EQ(point.contacts.size(), 1U);
    }
}

TYPED_TEST(CollisionSweep, PointBetweenTwoCollidersStaysBounded) {
    // Two plates close on a point until they touch, held for a second: it neither flies off nor gains speed.
    Colliders colliders;
    const int lower = colliders.add(boxShape({1.0, 0.1, 1.0}), {0.3, 0.5}, {{0.0, -0.15, 0.0}});
    const int upper = colliders.add(boxShape({1.0, 0.1, 1.0}), {0.3, 0.5}, {{0.0, 0.15, 0.0}});
    Flyer<TypeParam> point({0.0, 0.01, 0.0});
    point.thickness = 0.01;
    const double h = 1e-3;
    double gap = 0.05;
    for (int i = 0; i < 2000; ++i) {
        const double next = gap > 0.0 ? gap - 1e-4 : 0.0;
        colliders.move(lower, {.position = {0.0, -0.1 - gap, 0.0}}, {.position = {0.0, -0.1 - next, 0.0}});
        colliders.move(upper, {.position = {0.0, 0.1 + gap, 0.0}}, {.position = {0.0, 0.1 + next, 0.0}});
        gap = next;
        point.step(colliders, h, {0.0, -gravity, 0.0});
        ASSERT_LT(std::abs(static_cast<double>(point.x[1])), 0.05);
        ASSERT_LT(glm::length(point.velocity()), 1.0);  // a free fall of 5 cm ends at 0.99 m/s
        if (i > 600) ASSERT_LT(glm::length(point.velocity()), 2.0 * gravity * h);
    }
}

TYPED_TEST(CollisionSweep, PointInAGrooveOfAMeshStaysOnItsSide) {
    // A valley with an angle of 20 degrees at its bottom.
    SizedShape valley;
    valley.kind = "mesh";
    const double wide = core::sine(core::radians(10.0));
    const double tall = core::cosine(core::radians(10.0));
    valley.vertices = {{-wide, tall, -1.0}, {-wide, tall, 1.0}, {0.0, 0.0, -1.0},
                       {0.0, 0.0, 1.0},     {wide, tall, -1.0}, {wide, tall, 1.0}};
    valley.triangles = {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5};
    Colliders colliders;
    colliders.add(valley, {0.2, 0.0}, {});
    for (const double thickness : {0.0, 0.01}) {
        for (const double speed : {0.5, 100.0}) {
            Flyer<TypeParam> point({0.01, 0.5, 0.0}, {0.0, -speed, 0.0});
            point.thickness = thickness;
            for (int i = 0; i < 2000; ++i) {
                point.step(colliders, 1e-3, {0.0, -gravity, 0.0});
                const double y = static_cast<double>(point.x[1]);
                ASSERT_GT(y, 0.0) << i;
                ASSERT_LT(std::abs(static_cast<double>(point.x[0])), y * wide / tall + 1e-6) << i;
                ASSERT_LT(y, 0.6) << i;
            }
            EXPECT_LT(glm::length(point.velocity()), 0.05);
        }
    }
}

// A cloth's worth of points over several colliders.
struct Crowd {
    static constexpr int count = 1000;
    std::vector<double> before = std::vector<double>(3 * count);
    std::vector<double> x = std::vector<double>(3 * count);
    std::vector<double> v = std::vector<double>(3 * count);
    std::vector<double> inverseMass = std::vector<double>(count, 1.0);
    std::vector<Contact> contacts;

    Crowd() {
        for (int i = 0; i < count; ++i) {
            const auto at = static_cast<std::size_t>(i);
            before[at] = 0.05 * (i % 40) - 1.0;
            before[at + count] = 0.6;
            before[at + 2 * count] = 0.08 * (i / 40.0) - 1.0;
            v[at + count] = -60.0;
            if (i % 17 == 0) inverseMass[at] = 0.0;
            for (std::size_t k = 0; k < 3; ++k) x[at + k * count] = before[at + k * count] + v[at + k * count] / 60.0;
        }
    }
    void resolve(const Colliders& colliders, int first, int last) {
        MovingPoints<double> points{first, last, count, before.data(), x.data(), v.data(), inverseMass.data(),
                                    0.005, 1.0};
        colliders.resolve(points, 1.0 / 60.0, contacts);
    }
};

Colliders crowdedScene(int balls) {
    Colliders colliders;
    colliders.add(planeShape(), {}, {});
    for (int i = 0; i < balls; ++i) {
        const Pose pose{{0.02 * (i % 100) - 1.0, 0.1, 0.3 * (i % 7) - 1.0}};
        switch (i % 4) {
            case 0: colliders.add(roundShape("sphere", 0.2), {}, pose); break;
            case 1: colliders.add(boxHull({0.2, 0.1, 0.3}), {}, pose); break;
            case 2: colliders.add(boxMesh({0.2, 0.1, 0.3}), {}, pose); break;
            default: colliders.add(roundShape("cone", 0.2, 0.4), {}, pose);
        }
    }
    return colliders;
}

TEST(CollisionOrder, ContactsComeInThePointsOrder) {
    for (const int balls : {8, 100}) {  // 100: more than a block is tried against at once
        const Colliders colliders = crowdedScene(balls);
        Crowd crowd;
        crowd.resolve(colliders, 0, Crowd::count);
        ASSERT_GE(crowd.contacts.size(), 900U);
        for (std::size_t i = 1; i < crowd.contacts.size(); ++i)
            ASSERT_LE(crowd.contacts[i - 1].point, crowd.contacts[i].point);
        for (const Contact& contact : crowd.contacts) ASSERT_NE(contact.point % 17, 0);
    }
}

TEST(CollisionOrder, HowPointsAreCutIntoBodiesDoesNotMatter) {
    const Colliders colliders = crowdedScene(60);
    Crowd whole;
    whole.resolve(colliders, 0, Crowd::count);
    Crowd parts;
    for (int first = 0; first < Crowd::count; first += 77)
        parts.resolve(colliders, first, std::min(first + 77, Crowd::count));
    EXPECT_EQ(std::memcmp(whole.x.data(), parts.x.data(), whole.x.size() * sizeof(double)), 0);
    EXPECT_EQ(std::memcmp(whole.v.data(), parts.v.data(), whole.v.size() * sizeof(double)), 0);
}

TEST(CollisionOrder, ThreadsSideBySideFindTheSame) {
    const Colliders colliders = crowdedScene(60);
    Crowd alone;
    alone.resolve(colliders, 0, Crowd::count);
    Crowd crowds[2];
    for (int round = 0; round < 20; ++round) {
        crowds[0] = Crowd();
        crowds[1] = Crowd();
        std::thread other([&] { crowds[1].resolve(colliders, 0, Crowd::count); });
        crowds[0].resolve(colliders, 0, Crowd::count);
        other.join();
        for (const Crowd& crowd : crowds) {
            ASSERT_EQ(std::memcmp(alone.x.data(), crowd.x.data(), alone.x.size() * sizeof(double)), 0);
            ASSERT_EQ(std::memcmp(alone.v.data(), crowd.v.data(), alone.v.size() * sizeof(double)), 0);
            ASSERT_EQ(alone.contacts.size(), crowd.contacts.size());
        }
    }
}

}  // namespace
}  // namespace taut::collision
