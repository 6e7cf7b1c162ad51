#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "mechanics_planar_state.h"
#include "support/eigenvalues.h"
#include "taut/mechanics/private/filling.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using test::PlanarState;
using test::sum;
using Triangle = std::array<int, 3>;

// An octahedron of radius 1 about (2, 3, 4), its triangles turned this way and that. Its volume is 4/3.
struct Octahedron {
    std::vector<dvec3> places;
    std::vector<double> masses;
    std::vector<Triangle> triangles = {{0, 2, 4}, {2, 4, 1}, {1, 3, 4}, {3, 4, 0},
                                       {2, 5, 0}, {1, 2, 5}, {3, 1, 5}, {0, 5, 3}};

    Octahedron() {
        for (int i = 0; i < 6; ++i) {
            dvec3 place(2, 3, 4);
            place[i / 2] += i % 2 == 0 ? 1.0 : -1.0;
            places.push_back(place);
            masses.push_back(0.1 + 0.03 * i);
        }
    }
    // Each triangle becomes four, their corners as far from the middle as the others.
    void refine() {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<int>(places.size()));
            if (isNew) {
                const dvec3 centre(2, 3, 4);
                const dvec3 arm = 0.5 * (places[a] + places[b]) - centre;
                places.push_back(centre + glm::normalize(arm));
                masses.push_back(0.1);
            }
            return entry->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : triangles) {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) finer.push_back(t);
        }
        triangles = finer;
    }
    Filling<double> filling(const FillingLaw& law, double pressure = 200.0) const {
        return {chambersOf(triangles, places), places, law, {pressure, pressure}};
    }
};

const std::array<FillingLaw, 3> laws = {FillingLaw{FillingKeeps::pressure, 1000.0, 1000.0, 1.0},
                                        FillingLaw{FillingKeeps::amount, 1000.0, 1000.0, 1.0},
                                        FillingLaw{FillingKeeps::volume, 1000.0, 1000.0, 5000.0}};

TEST(Filling, SurfacesAreClosedOpenTwistedOrFlat) {
    const Octahedron solid;
    const std::vector<Chamber> closed = chambersOf(solid.triangles, solid.places);
    ASSERT_EQ(closed.size(), 1U);
    EXPECT_TRUE(closed[0].isClosed());
    EXPECT_NEAR(closed[0].firstVolume, 4.0 / 3.0, 1e-15);
    for (const Triangle& t : closed[0].triangles) {  // all turned outwards
        const auto at = [&](std::size_t k) { return solid.places[t[k]]; };
        EXPECT_GT(glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(0) - dvec3(2, 3, 4)), 0.0);
    }

    std::vector<Triangle> some(solid.triangles.begin() + 1, solid.triangles.end());
    EXPECT_EQ(chambersOf(some, solid.places)[0].openEdges, 3);
    // Two halves of points of their own, but the four around the middle of the second are one with those of the first.
    std::vector<Triangle> halves(solid.triangles.begin(), solid.triangles.begin() + 4);
    std::vector<dvec3> twice = solid.places;
    twice.insert(twice.end(), solid.places.begin(), solid.places.end());
    for (std::size_t t = 4; t < 8; ++t) {
        halves.push_back(solid.triangles[t]);
        for (int& i : halves.back()) i += 6;
    }
    EXPECT_EQ(chambersOf(halves, twice).size(), 2U);
    const std::vector<Chamber> sewn = chambersOf(halves, twice, std::vector<int>{0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 10, 11});
    ASSERT_EQ(sewn.size(), 1U);
    EXPECT_TRUE(sewn[0].isClosed());
    EXPECT_NEAR(sewn[0].firstVolume, 4.0 / 3.0, 1e-15);
    // Half a metre apart and not closed yet, they enclose the prism between them too, on a square of 2 m².
    for (std::size_t i = 6; i < 12; ++i) twice[i].z -= 0.5;
    const std::vector<Chamber> apart =
        chambersOf(halves, twice, std::vector<int>{0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 10, 11});
    EXPECT_NEAR(apart.at(0).firstVolume, 7.0 / 3.0, 1e-14);
    PlanarState<double> state(twice, std::vector<double>(12, 1.0));
    const std::vector<dvec3> forces = state.forces(Filling<double>(apart, twice, laws[0], {200.0, 200.0}));
    dvec3 torque(0.0);
    for (int i = 0; i < 12; ++i) torque += glm::cross(state.get(state.x, i), forces[i]);
    EXPECT_LT(glm::length(sum(forces)) + glm::length(torque), 1e-11);

    // Möbius's band of five triangles; a pillow of two squares, with another at a corner that is sewn to itself.
    const std::vector<Triangle> band = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}};
    EXPECT_TRUE(chambersOf(band, solid.places)[0].isTwisted);
    const std::vector<Triangle> pillow = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const std::vector<dvec3> flat = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {2, 1, 0}};
    std::vector<Triangle> more = pillow;
    more.push_back({1, 2, 4});
    more.push_back({2, 1, 4});
    for (const std::vector<Triangle>& triangles : {pillow, more}) {
        const std::vector<Chamber> chambers = chambersOf(triangles, flat);
        ASSERT_EQ(chambers.size(), 1U);
        EXPECT_TRUE(chambers[0].isClosed());
        EXPECT_EQ(chambers[0].firstVolume, 0.0);
        EXPECT_EQ(chambers[0].triangles.size(), 4U);
    }
}

// As cells of a block may. Two corners of a cube, each a sixth of it.
TEST(Filling, PartsThatMeetAlongAnEdgeAreClosed) {
    const std::vector<dvec3> places{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    const std::vector<Triangle> both{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3},
                                     {0, 4, 1}, {0, 5, 4}, {0, 1, 5}, {1, 4, 5}};
    const std::vector<Chamber> chambers = chambersOf(both, places);
    ASSERT_EQ(chambers.size(), 1U);
    EXPECT_TRUE(chambers[0].isClosed());
    EXPECT_NEAR(chambers[0].firstVolume, 2.0 / 6.0, 1e-15);
}

// The last is sealed in at 1000 Pa and then taken up to where the air has 900.
TEST(Filling, PressesAsItsLawSays) {
    const Octahedron solid;
    const double s = 1.1, v = s * s * s;  // of all lengths, of the volume
    std::vector<FillingLaw> all(laws.begin(), laws.end());
    all.push_back({FillingKeeps::amount, 900.0, 1000.0, 1.0});
    const std::array<double, 4> expected = {200.0, 1200.0 / v - 1000.0, 200.0 + 5000.0 * (1.0 - v), 1200.0 / v - 900.0};
    for (std::size_t law = 0; law < 4; ++law) {
        PlanarState<double> state(solid.places, solid.masses);
        if (all[law].keeps == FillingKeeps::amount)  // its energy is that since it was sealed
            EXPECT_NEAR(solid.filling(all[law]).potentialEnergy(state.motion()), 0.0, 1e-12);
        for (double& x : state.x) x *= s;
        const std::vector<dvec3> forces = state.forces(solid.filling(all[law]));
        // Each of four triangles has an area of ½ √3 and a normal of 1/√3 along the axis; a third of them.
        EXPECT_NEAR(forces[0].x, expected[law] * s * s * 4.0 / 6.0, 1e-10) << law;
    }
}

// A tenth of the volume is left at 0.46 of the lengths; below, a pump draws in proportion to the rest, and where
// the surface is inside out not at all. The forces along the arms are -dE/ds.
TEST(Filling, SucksNothingInsideOut) {
    const Octahedron solid;
    const Filling<double> filling = solid.filling(laws[0], -200.0);
    for (const auto& [s, share] : {std::pair(0.5, 1.0), {0.4, 0.64}, {-0.4, 0.0}}) {
        PlanarState<double> state(solid.places, solid.masses);
        const auto energyAt = [&](double size) {
            for (std::size_t i = 0; i < solid.places.size(); ++i)
                state.set(state.x, static_cast<int>(i), size * solid.places[i]);
            return filling.potentialEnergy(state.motion());
        };
        const double h = 1e-5, slope = (energyAt(s + h) - energyAt(s - h)) / (2.0 * h);
        energyAt(s);
        EXPECT_NEAR(state.forces(filling)[0].x, -200.0 * share * s * s * 4.0 / 6.0, 1e-10) << s;
        EXPECT_NEAR(slope, 200.0 * share * 4.0 * s * s, 1e-6) << s;
    }
}

TEST(Filling, ForcesAreTheSlopeOfTheEnergyAndProductsThatOfTheForces) {
    const Octahedron solid;
    for (const FillingLaw& law : laws) {
        PlanarState<double> state(solid.places, solid.masses);
        state.shake(0.2, 0.0);
        const Filling<double> filling = solid.filling(law);
        const std::vector<dvec3> forces = state.forces(filling);
        dvec3 torque(0.0);
        for (int i = 0; i < 6; ++i) torque += glm::cross(state.get(state.x, i), forces[i]);
        EXPECT_LT(glm::length(sum(forces)) + glm::length(torque), 1e-11);  // rounding of 1e3 N
        const double h = 1e-5;
        for (int i = 0; i < 6; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                core::AlignedArray<double> u(state.planes()), product(state.planes());
                u[state.index(i, axis)] = 1.0;
                filling.addStiffnessProduct(state.motion(), u.data(), product.data());
                const double here = state.x[state.index(i, axis)];
                state.x[state.index(i, axis)] = here + h;
                const double up = filling.potentialEnergy(state.motion());
                const std::vector<dvec3> above = state.forces(filling);
                state.x[state.index(i, axis)] = here - h;
                const double down = filling.potentialEnergy(state.motion());
                const std::vector<dvec3> below = state.forces(filling);
                state.x[state.index(i, axis)] = here;
                // Rounding of a thousand joules, 1e-13 J / h; third derivatives of some thousands, h² times that.
                EXPECT_NEAR(forces[i][axis], (down - up) / (2.0 * h), 1e-6);
                for (int j = 0; j < 6; ++j)
                    for (int k = 0; k < 3; ++k) {
                        const auto p = static_cast<std::size_t>(j);
                        EXPECT_NEAR(product[state.index(j, k)], (below[p][k] - above[p][k]) / (2.0 * h), 1e-5);
                    }
            }
    }
}

// Implicit methods use of K the part -dΔp/dV g gᵀ: at Δp = 0 that is all of it.
TEST(Filling, ImplicitMethodsGetTheWholeStiffnessWhereNothingPresses) {
    const Octahedron solid;
    for (const FillingLaw& law : {laws[1], laws[2]}) {
        PlanarState<double> state(solid.places, solid.masses);
        Filling<double> filling(chambersOf(solid.triangles, solid.places), solid.places, law, {0.0, 0.0});
        filling.linearise(state.motion(), 0.25, 7.0);
        PlanarState<double> way(solid.places, solid.masses);
        std::fill(way.x.begin(), way.x.end(), 0.0);
        way.shake(1.0, 0.0);
        core::AlignedArray<double> whole(state.planes()), taken(state.planes()), diagonal(state.planes());
        filling.addStiffnessProduct(state.motion(), way.x.data(), whole.data());
        filling.addProduct(state.stride, way.x.data(), taken.data());
        filling.addDiagonal(state.stride, diagonal.data());
        for (int i = 0; i < 6; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t at = state.index(i, axis);
                EXPECT_NEAR(taken[at], 0.25 * whole[at], 1e-10);
                core::AlignedArray<double> u(state.planes()), column(state.planes());
                u[at] = 1.0;
                filling.addProduct(state.stride, u.data(), column.data());
                EXPECT_NEAR(diagonal[at], column[at], 1e-12);
            }
    }
}

// The largest eigenvalue of M^{-1/2} K M^{-1/2} of a ball, at first and as small as it may become. Of a
// gas the share holds for surfaces that are crumpled besides, with (1.44 / 0.77)² = 3.5 times the stiffness.
TEST(Filling, ItsShareOfTheBoundIsAboveTheTruthAndNear) {
    Octahedron solid;
    solid.refine();
    const std::size_t n = solid.places.size();
    for (const FillingLaw& law : laws) {
        const Filling<double> filling = solid.filling(law);
        const PlanarState<double> first(solid.places, solid.masses);
        const StabilityShare share = first.stability(filling);
        double bound = 0.0, most = 0.0;
        for (std::size_t i = 0; i < n; ++i) bound = std::max(bound, share.stiffness[i] / solid.masses[i]);
        for (const double size : {1.0, 0.88}) {
            PlanarState<double> state(solid.places, solid.masses);
            for (double& x : state.x) x *= size;
            taut::test::Matrix matrix(3 * n);
            for (std::size_t column = 0; column < 3 * n; ++column) {
                core::AlignedArray<double> u(state.planes()), out(state.planes());
                u[state.index(static_cast<int>(column / 3), static_cast<int>(column % 3))] = 1.0;
                filling.addStiffnessProduct(state.motion(), u.data(), out.data());
                for (std::size_t row = 0; row < 3 * n; ++row)
                    matrix.at(row, column) = out[state.index(static_cast<int>(row / 3), static_cast<int>(row % 3))] /
                                             std::sqrt(solid.masses[row / 3] * solid.masses[column / 3]);
            }
            most = std::max(most, taut::test::eigenvalues(matrix).back());
        }
        EXPECT_LE(most, bound);
        EXPECT_GE(most, bound / (law.keeps == FillingKeeps::amount ? 10.0 : 6.0));
    }
}

}  // namespace
}  // namespace taut::mechanics
