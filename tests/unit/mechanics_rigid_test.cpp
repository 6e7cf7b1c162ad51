// Rigid bodies made of points, against exact mass properties and Jacobi's solution of the free top.
#include "taut/mechanics/rigid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>

#include "taut/core/rigid_motion.h"

namespace taut::mechanics {
namespace {

using core::MassProperties;
using core::massPropertiesOf;

constexpr double pi = 3.14159265358979323846;

// A box with its corners, and triangles that face outward.
RigidShape boxOf(const dvec3& size) {
    RigidShape shape;
    for (int i = 0; i < 8; ++i)
        shape.positions.emplace_back(0.5 * size * dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    shape.properties = massPropertiesOf(shape.positions, shape.triangles);
    return shape;
}

TEST(Rigid, PropertiesOfAPolyhedronAreExact) {
    const RigidShape box = boxOf({0.3, 0.2, 0.1});
    EXPECT_NEAR(box.properties.volume, 0.006, 1e-16);
    for (int k = 0; k < 3; ++k) {
        const double edge = k == 0 ? 0.3 : k == 1 ? 0.2 : 0.1;
        EXPECT_NEAR(box.properties.spread[k][k], 0.006 * edge * edge / 12, 1e-18);
    }
    // Of its two halves, one of them turned to stand as the other does; and where one half weighs three times as much.
    for (const double factor : {1.0, 3.0}) {
        RigidShape half = boxOf({0.15, 0.2, 0.1}), turned = boxOf({0.2, 0.15, 0.1}), both;
        half.mass = factor;
        half.place = {-0.075, 0.0, 0.0};
        turned.place = {0.075, 0.0, 0.0};
        turned.axes = dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1);
        both.mass = 0;
        join(both, half);
        join(both, turned);
        const double middle = (1.0 - factor) / (1.0 + factor) * 0.075;
        EXPECT_NEAR(both.mass, 1.0 + factor, 1e-15);
        EXPECT_LT(glm::distance(both.properties.centre, dvec3(middle, 0.0, 0.0)), 1e-16);
        for (int k = 0; k < 3; ++k) {
            const double away = k == 0 ? middle : 0.0;
            EXPECT_NEAR(both.properties.spread[k][k], box.properties.spread[k][k] - 0.006 * away * away, 1e-18);
        }
    }
    // A tetrahedron far from the origin: its centre is the mean of its corners.
    const std::vector<dvec3> corners{{10, 5, 2}, {11, 5, 2}, {10, 7, 2}, {10, 5, 5}};
    const std::vector<std::array<int, 3>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    const MassProperties tetrahedron = massPropertiesOf(corners, faces);
    EXPECT_NEAR(tetrahedron.volume, 1.0, 1e-14);
    EXPECT_LT(glm::distance(tetrahedron.centre, dvec3(10.25, 5.5, 2.75)), 1e-14);
    EXPECT_NEAR(tetrahedron.spread[0][0], 3.0 / 80.0, 1e-15);  // V a² 3/80
}

// A polyhedron of many sides in the shape comes near it by 2/3 (2π/n)² and less.
TEST(Rigid, PropertiesOfRoundShapesAreThoseOfFinePolyhedra) {
    constexpr int n = 1000;
    constexpr double radius = 0.3, height = 0.5;
    for (const bool isCone : {false, true}) {
        std::vector<dvec3> x{{0.0, -0.5 * height, 0.0}, {0.0, 0.5 * height, 0.0}};
        std::vector<std::array<int, 3>> triangles;
        for (int k = 0; k < n; ++k) {
            const double angle = 2 * pi * k / n;
            for (const double y : {-0.5 * height, 0.5 * height})
                x.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
            const int a = 2 + 2 * k, b = 2 + 2 * ((k + 1) % n);
            triangles.push_back({0, a, b});
            if (isCone)
                triangles.push_back({1, b, a});
            else
                triangles.insert(triangles.end(), {{a, a + 1, b}, {b, a + 1, b + 1}, {1, b + 1, a + 1}});
        }
        const MassProperties fine = massPropertiesOf(x, triangles);
        const MassProperties own =
            isCone ? core::massPropertiesOfCone(radius, height) : core::massPropertiesOfCylinder(radius, height);
        EXPECT_NEAR(own.volume / fine.volume, 1.0, 3e-5);
        EXPECT_LT(glm::distance(own.centre, fine.centre), 1e-9);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(own.spread[k][k] / fine.spread[k][k], 1.0, 3e-5);
    }
}

TEST(Rigid, PointsHaveTheInertiaOfTheBody) {
    RigidShape capsule;
    capsule.positions = {{0.0, -0.2, 0.0}, {0.0, 0.2, 0.0}};
    capsule.lines = {{0, 1}};
    capsule.properties = core::massPropertiesOfCapsule(0.1, 0.4);
    RigidShape lopsided = boxOf({0.3, 0.2, 0.1});
    lopsided.positions.resize(5);  // points that touch only on one side
    lopsided.triangles.clear();
    for (RigidShape shape : {capsule, lopsided}) {
        shape.mass = 3.0;
        const Model model = buildRigid(shape);
        double mass = 0;
        dvec3 moment(0.0);
        glm::dmat3 spread(0.0);
        for (std::size_t i = 0; i < model.masses.size(); ++i) {
            EXPECT_GT(model.masses[i], 0.0);
            mass += model.masses[i];
            moment += model.masses[i] * model.positions[i];
            spread += glm::outerProduct(model.masses[i] * model.positions[i], model.positions[i]);
        }
        EXPECT_NEAR(mass, 3.0, 1e-14);
        EXPECT_LT(glm::length(moment), 1e-15);
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(glm::length(spread[k] - 3.0 / shape.properties.volume * shape.properties.spread[k]), 1e-15);
    }
    // ∫ of a capsule by slices across its axis.
    double volume = 0, across = 0, along = 0;
    constexpr int slices = 20000;
    for (int i = 0; i < slices; ++i) {
        const double y = -0.3 + 0.6 * (i + 0.5) / slices, over = std::max(0.0, std::abs(y) - 0.2);
        const double square = 0.01 - over * over, area = pi * square * 0.6 / slices;
        volume += area;
        across += area * square / 4;
        along += area * y * y;
    }
    EXPECT_NEAR(capsule.properties.volume / volume, 1.0, 1e-7);
    EXPECT_NEAR(capsule.properties.spread[0][0] / across, 1.0, 1e-7);
    EXPECT_NEAR(capsule.properties.spread[1][1] / along, 1.0, 1e-7);
}

// A box that spins about its middle axis turns over and back, again and again: with L and E its rate about that axis is
// an elliptic sine of period 4 K(m) / rate. Steps of leap-frog, 60 to a turn.
TEST(Rigid, TurnsOverAsTheFreeTopDoes) {
    const RigidShape shape = boxOf({0.3, 0.2, 0.1});
    const Model model = buildRigid(shape);
    const std::span<const double> masses = model.masses;
    std::vector<dvec3> x = model.positions, v(x.size());
    const dvec3 spin(0.05, 6.0, 0.02);
    for (std::size_t i = 0; i < x.size(); ++i) v[i] = glm::cross(spin, x[i]);
    // Of x, y, z: 1/12 (b² + c²), smallest first.
    const double i1 = (0.04 + 0.01) / 12, i2 = (0.09 + 0.01) / 12, i3 = (0.09 + 0.04) / 12;
    const double energy2 = i1 * spin.x * spin.x + i2 * spin.y * spin.y + i3 * spin.z * spin.z;
    const double square = i1 * i1 * spin.x * spin.x + i2 * i2 * spin.y * spin.y + i3 * i3 * spin.z * spin.z;
    ASSERT_LT(square, energy2 * i2);  // so it comes back to the axis with the smallest inertia
    const double rate = std::sqrt((i2 - i1) * (i3 * energy2 - square) / (i1 * i2 * i3));
    const double m = (i3 - i2) * (square - i1 * energy2) / ((i2 - i1) * (i3 * energy2 - square));
    double a = 1, b = std::sqrt(1 - m);  // K = π / 2 AGM(1, √(1 - m))
    for (int k = 0; k < 8; ++k) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    const double period = 4 * (0.5 * pi / a) / rate;

    constexpr double h = 2 * pi / 6.0 / 60;
    const core::RigidMotion start = core::rigidMotionOf(masses, x, v);
    const dvec3 momentum = glm::inverse(start.inverseInertia) * start.spin;
    double low = 1e300, high = 0;
    std::vector<double> turns;  // when the spin about the middle axis goes through 0, upwards
    double before = 1;
    for (int k = 0; k < 100000; ++k) {
        const std::vector<dvec3> from = x;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += h * v[i];
        placeRigidly(masses, model.positions, from, x);
        for (std::size_t i = 0; i < x.size(); ++i) v[i] = (x[i] - from[i]) / h;
        double energy = 0;
        for (std::size_t i = 0; i < x.size(); ++i) energy += 0.5 * masses[i] * glm::dot(v[i], v[i]);
        low = std::min(low, energy);
        high = std::max(high, energy);
        const dvec3 axis = glm::normalize(x[8] - x[6]);  // of two corners, along the middle edge
        const double about = glm::dot(core::rigidMotionOf(masses, from, v).spin, axis);
        if (before < 0 && about >= 0) turns.push_back((k + before / (before - about)) * h);
        before = about;
    }
    ASSERT_GT(turns.size(), 100U);
    EXPECT_NEAR((turns.back() - turns.front()) / static_cast<double>(turns.size() - 1) / period, 1.0, 0.01);
    EXPECT_LT(high / low, 1.004);  // it swings by O(h²), and does not drift
    // Σ m from × x / h is conserved by the step.
    std::vector<dvec3> to = x;
    for (std::size_t i = 0; i < x.size(); ++i) to[i] += h * v[i];
    dvec3 kept(0.0);
    for (std::size_t i = 0; i < x.size(); ++i) kept += masses[i] * glm::cross(x[i], to[i]) / h;
    EXPECT_LT(glm::length(kept - momentum) / glm::length(momentum), 1e-10);
    // A body stays one.
    for (std::size_t i = 1; i < x.size(); ++i)
        EXPECT_NEAR(glm::distance(x[i], x[0]), glm::distance(model.positions[i], model.positions[0]), 1e-15);
}

// A step that turns a body by θ has the momentum of sin θ. Three times that of a quarter turn ends with about that
// turn, half a radian off at most, as Newton's rounds are no longer.
TEST(Rigid, NoStepTurnsByMoreThanAQuarter) {
    const Model model = buildRigid(boxOf({0.3, 0.2, 0.1}));
    const std::vector<dvec3>& from = model.positions;
    std::vector<dvec3> x = from;
    for (dvec3& own : x) own += glm::cross(dvec3(0, 0, 3), own);
    placeRigidly(model.masses, from, from, x);
    for (std::size_t i = 1; i < x.size(); ++i)
        EXPECT_NEAR(glm::distance(x[i], x[0]), glm::distance(from[i], from[0]), 1e-15);
    const dvec3 before = glm::normalize(from[8] - from[6]), after = glm::normalize(x[8] - x[6]);
    EXPECT_LT(std::abs(glm::dot(before, after)), std::sin(0.5));
}

}  // namespace
}  // namespace taut::mechanics
