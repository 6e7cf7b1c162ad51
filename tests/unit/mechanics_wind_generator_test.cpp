#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "mechanics_planar_state.h"
#include "support/eigenvalues.h"
#include "taut/core/trig.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/wind.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using test::PlanarState;
using test::sum;

constexpr double windRounding = 1e-12;  // forces of a few N in double

// A right triangle of ½ m² whose normal lies at the angle α from the y-z plane's, so that wind along x meets its
// plane at α.
std::vector<dvec3> plateAt(double alpha) {
    const dvec3 along(-std::cos(alpha), std::sin(alpha), 0.0), across(0, 0, -1);
    return {dvec3(0.0), along, across};
}
const std::vector<double> sheetMasses = {0.1, 0.1, 0.1};
const std::vector<std::array<int, 3>> one = {{0, 1, 2}};

WindSettings settings(double drag, double lift) {
    WindSettings s;
    s.drag = drag;
    s.lift = lift;
    return s;
}

// The formula of the header, written for one triangle.
dvec3 expectedForce(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& u, const WindSettings& s) {
    const dvec3 cross = glm::cross(b - a, c - a);
    const double area = 0.5 * glm::length(cross);
    dvec3 n = glm::normalize(cross);
    if (glm::dot(n, u) < 0.0) n = -n;
    const double un = glm::dot(u, n), speed = glm::length(u);
    return 0.5 * s.airDensity * area * un * (s.drag * u + s.lift * (speed * n - un / speed * u));
}

Model sheet() {
    ClothShape shape;
    shape.cells = {37, 29};
    shape.size = {1.85, 1.45};
    return buildCloth(shape);
}

TEST(Wind, FlatPlateAcrossTheFlowHasHalfRhoACdUSquared) {
    PlanarState<double> state(plateAt(core::pi / 2), sheetMasses);
    const Wind<double> wind(one, {6, 0, 0}, settings(1.2, 0.6));
    const std::vector<dvec3> f = state.forces(wind);
    EXPECT_NEAR(sum(f).x, 0.5 * 1.2 * 0.5 * 1.2 * 36.0, windRounding);
    EXPECT_NEAR(sum(f).y, 0.0, windRounding);
    for (const dvec3& corner : f) EXPECT_NEAR(glm::length(corner - f[0]), 0.0, windRounding);
}

TEST(Wind, DragIsForTheAreaThatTheFlowSeesAndLiftTurnsTowardsTheNormal) {
    for (double alpha : {0.1, 0.5, 1.0, 1.4}) {
        PlanarState<double> state(plateAt(alpha), sheetMasses);
        const dvec3 drag = sum(state.forces(Wind<double>(one, {5, 0, 0}, settings(1.0, 0.0))));
        const dvec3 lift = sum(state.forces(Wind<double>(one, {5, 0, 0}, settings(0.0, 1.0))));
        const double head = 0.5 * 1.2 * 0.5 * 25.0;
        EXPECT_NEAR(glm::length(drag - dvec3(head * std::sin(alpha), 0, 0)), 0.0, windRounding);
        EXPECT_NEAR(glm::length(lift - dvec3(0, head * std::sin(alpha) * std::cos(alpha), 0)), 0.0, windRounding);
    }
}

TEST(Wind, EdgeOnVanishesWithoutAJump) {
    for (double alpha : {1e-6, -1e-6}) {
        PlanarState<double> state(plateAt(alpha), sheetMasses);
        EXPECT_LT(glm::length(sum(state.forces(Wind<double>(one, {5, 0, 0}, settings(1.0, 0.6))))), 2e-5);
    }
}

TEST(Wind, WindingDoesNotMatter) {
    PlanarState<double> state(plateAt(0.4), sheetMasses);
    const std::vector<std::array<int, 3>> turned = {{0, 2, 1}};
    const dvec3 f = sum(state.forces(Wind<double>(one, {5, 1, 2}, settings(1.0, 0.6))));
    const dvec3 g = sum(state.forces(Wind<double>(turned, {5, 1, 2}, settings(1.0, 0.6))));
    EXPECT_NEAR(glm::length(f - g), 0.0, windRounding);
}

TEST(Wind, AirThatMovesWithTheClothHasNoForce) {
    PlanarState<double> state(sheet());
    for (const dvec3& f : state.forces(Wind<double>(sheet().triangles, dvec3(0.0), {}))) EXPECT_EQ(f, dvec3(0.0));
    for (int i = 0; i < state.count; ++i) state.set(state.v, i, {2, 1, -4});
    for (const dvec3& f : state.forces(Wind<double>(sheet().triangles, {2, 1, -4}, {})))
        EXPECT_LT(glm::length(f), 1e-30);  // u is one rounding of 4 at most, and the force goes with its square
}

TEST(Wind, OnlyRelativeVelocityCounts) {
    PlanarState<double> still(plateAt(0.7), sheetMasses), moving(plateAt(0.7), sheetMasses);
    for (int i = 0; i < 3; ++i) moving.set(moving.v, i, {1, 2, 3});
    const dvec3 f = sum(still.forces(Wind<double>(one, {4, -1, 2}, {})));
    const dvec3 g = sum(moving.forces(Wind<double>(one, {5, 1, 5}, {})));
    EXPECT_NEAR(glm::length(f - g), 0.0, windRounding);
}

// A plate that falls flat stops gaining speed at √(2 m g / ρ A C_D).
TEST(Wind, CarriesTheWeightAtTheTerminalSpeed) {
    const std::vector<dvec3> flat = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    const double weight = 0.3 * 9.81, terminal = std::sqrt(2.0 * weight / (1.2 * 0.5 * 1.0));
    for (double factor : {0.9, 1.0, 1.1}) {
        PlanarState<double> state(flat, sheetMasses);
        for (int i = 0; i < 3; ++i) state.set(state.v, i, {0, -factor * terminal, 0});
        const double up = sum(state.forces(Wind<double>(one, dvec3(0.0), {}))).y;
        EXPECT_NEAR(up, factor * factor * weight, windRounding);
    }
}

TEST(Wind, ClothFeelsTheFormulaInEveryTriangleGustsIncluded) {
    const Model model = sheet();
    PlanarState<double> state(model);
    state.shake(0.01, 1.0);
    WindSettings s;
    s.gust = {2.5, 1.7, 2.0, 7};
    const Wind<double> wind(model.triangles, {6, 0, 1}, s);
    std::vector<dvec3> expected(model.positions.size(), dvec3(0.0));
    for (const auto& triangle : model.triangles) {
        dvec3 p[3], u(0.0);
        for (std::size_t c = 0; c < 3; ++c) {
            p[c] = state.get(state.x, triangle[c]);
            u += (wind.airVelocity(p[c], 0.75) - state.get(state.v, triangle[c])) / 3.0;
        }
        for (int i : triangle) expected[i] += expectedForce(p[0], p[1], p[2], u, s) / 3.0;
    }
    const std::vector<dvec3> f = state.forces(wind, 0.75);
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(glm::length(f[i] - expected[i]), 0.0, windRounding);
}

TEST(Wind, OrderOfTrianglesMattersOnlyInRounding) {
    const Model model = sheet();
    PlanarState<double> state(model);
    state.shake(0.01, 1.0);
    std::vector<std::array<int, 3>> mixed;  // every 7th: no runs left
    const std::size_t n = model.triangles.size();
    ASSERT_NE(n % 7, 0U);
    for (std::size_t k = 0; k < n; ++k) mixed.push_back(model.triangles[7 * k % n]);
    const std::vector<dvec3> f = state.forces(Wind<double>(model.triangles, {6, 0, 1}, {}));
    const std::vector<dvec3> g = state.forces(Wind<double>(mixed, {6, 0, 1}, {}));
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(glm::length(f[i] - g[i]), 0.0, windRounding);
}

template <class Real>
void expectSameWindBits() {
    Model model = sheet();
    // The grid's rows run; these do not.
    for (int k = 0; k < 90; ++k) model.triangles.push_back({3 * k, 1100 - 2 * k, 500 + (k * 37) % 450});
    PlanarState<Real> state(model);
    state.shake(0.01, 1.0);
    WindSettings s;
    s.gust = {2.5, 1.7, 2.0, 7};
    core::AlignedArray<Real> first;
    test::forEachInstructionSet([&] {
        state.forces(Wind<Real>(model.triangles, {6, 0, 1}, s), 0.75);
        if (first.empty()) first = state.f;
        EXPECT_EQ(std::memcmp(first.data(), state.f.data(), first.size() * sizeof(Real)), 0)
            << core::nameOf(core::instructionSet());
    });
}

TEST(Wind, HasTheSameBitsForEveryInstructionSet) {
    expectSameWindBits<float>();
    expectSameWindBits<double>();
}

TEST(Wind, DegenerateTrianglesStayFinite) {
    const std::vector<dvec3> points = {{0, 0, 0}, {1, 0, 0},         {2, 0, 0},
                                       {1, 0, 0}, {1e-22, 1e-22, 0}, {0, 1e-22, 1e-22}};
    const std::vector<double> mass(points.size(), 1.0);
    const std::vector<std::array<int, 3>> bad = {{0, 1, 2}, {1, 3, 2}, {1, 3, 1}, {0, 4, 5}};
    PlanarState<float> state(points, mass);
    WindSettings s;
    s.gust.amplitude = 1.0;
    for (const dvec3& velocity : {dvec3(5, 3, 1), dvec3(0.0), dvec3(1e-30, 0, 0)})
        for (const dvec3& f : state.forces(Wind<float>(bad, velocity, s))) {
            EXPECT_TRUE(std::isfinite(f.x) && std::isfinite(f.y) && std::isfinite(f.z));
            EXPECT_LT(glm::length(f), 1e-6);  // areas are 0 but for float rounding of coordinates near 1
        }
}

// The formulas of the header: across a rod counts alone, on a ball all does, on one side of a triangle half of the
// sheet's.
TEST(Wind, ActsOnRodsAndBallsAndOnOneSide) {
    PlanarState<double> state(std::vector<dvec3>{{0, 0, 0}, {0.3, 0.4, 0}, {2, 0, 0}, {0, 0, 1}},
                              std::vector<double>(4, 0.1));
    const dvec3 flow(5, 0, 2), axis(0.6, 0.8, 0), across = flow - glm::dot(flow, axis) * axis;
    const auto forces = [&](const WindTargets& targets) {
        return state.forces(Wind<double>(targets, LinearPath{flow, flow}, settings(1.1, 0.6)));
    };
    const std::vector<dvec3> rod = forces({.rounds = {{.a = 0, .b = 1, .width = 0.02}}});
    const dvec3 drag = 0.5 * 1.2 * 1.1 * 0.02 * 0.5 * glm::length(across) * across;
    for (std::size_t end : {0U, 1U}) EXPECT_LT(glm::length(rod[end] - 0.5 * drag), windRounding);
    const std::vector<dvec3> ball = forces({.rounds = {{.a = 2, .b = 2, .area = 0.07}}});
    EXPECT_LT(glm::length(ball[2] - 0.5 * 1.2 * 1.1 * 0.07 * glm::length(flow) * flow), windRounding);
    const std::vector<dvec3> sheet = forces({.triangles = {{0, 1, 3}}});
    const std::vector<dvec3> side = forces({.triangles = {{0, 1, 3}}, .sides = {0.5}});
    for (std::size_t i : {0U, 1U, 3U}) EXPECT_LT(glm::length(side[i] - 0.5 * sheet[i]), windRounding);
}

TEST(Wind, VelocityRisesEvenlyBetweenItsTimes) {
    Wind<double> wind(one, {2, 0, 0}, {});
    wind.setVelocity({2, 0, 0}, {6, 0, 0}, 1.0, 3.0);
    EXPECT_EQ(wind.airVelocity({0, 0, 0}, 0.0), dvec3(2, 0, 0));
    EXPECT_EQ(wind.airVelocity({0, 0, 0}, 2.0), dvec3(4, 0, 0));
    PlanarState<double> state(plateAt(core::pi / 2), sheetMasses);
    EXPECT_NEAR(sum(state.forces(wind, 2.0)).x, 0.5 * 1.2 * 0.5 * 16.0, windRounding);
    EXPECT_NEAR(sum(state.forces(wind, 9.0)).x, 0.5 * 1.2 * 0.5 * 36.0, windRounding);
}

// The largest |∂F/∂v| over many attitudes, from differences, against the share of a corner: a third of it, over m.
TEST(Wind, DampingShareBoundsTheSlopeOfTheForce) {
    const double working = 8.0, h = 1e-5;
    for (const auto& [drag, lift] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {1.0, 0.6}, {0.5, 1.5}}) {
        WindSettings s = settings(drag, lift);
        s.workingSpeed = working;
        double steepest = 0.0, bound = 0.0;
        for (double alpha = 0.013; alpha < 1.6; alpha += 0.05) {
            PlanarState<double> state(plateAt(alpha), sheetMasses);
            const Wind<double> wind(one, {working, 0, 0}, s);
            double slope[3][3];
            for (int axis = 0; axis < 3; ++axis) {
                auto forceAt = [&](double speed) {
                    for (int i = 0; i < 3; ++i) state.v[state.index(i, axis)] = speed;
                    const dvec3 f = sum(state.forces(wind));
                    for (int i = 0; i < 3; ++i) state.v[state.index(i, axis)] = 0.0;
                    return f;
                };
                const dvec3 d = (forceAt(h) - forceAt(-h)) / (2.0 * h);
                for (int row = 0; row < 3; ++row) slope[row][axis] = d[row];
            }
            taut::test::Matrix squared(3);
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    for (std::size_t k = 0; k < 3; ++k) squared.at(i, j) += slope[k][i] * slope[k][j];
            steepest = std::max(steepest, std::sqrt(taut::test::eigenvalues(squared).back()));
            bound = state.stability(wind).dampingRate[0] * sheetMasses[0] * 3.0;
        }
        EXPECT_LE(steepest, bound * (1.0 + 1e-6)) << drag << ' ' << lift;  // differences are good to h²
        EXPECT_GE(steepest, 0.5 * bound) << drag << ' ' << lift;
    }
}

TEST(Wind, WorkingSpeedIsTwiceTheFastestAirAndAtLeastTen) {
    Wind<double> wind(one, {1, 0, 0}, {});
    EXPECT_EQ(wind.workingSpeed(), 10.0);
    WindSettings s;
    s.gust.amplitude = 2.0;
    wind.setSettings(s);
    wind.setVelocity({0, 0, 0}, {0, 0, 9}, 1.0, 2.0);
    EXPECT_EQ(wind.workingSpeed(), 22.0);
}

}  // namespace
}  // namespace taut::mechanics
