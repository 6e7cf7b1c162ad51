#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mechanics_planar_state.h"
#include "support/eigenvalues.h"
#include "taut/mechanics/bending.h"
#include "taut/mechanics/private/grid_bending.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using test::PlanarState;

constexpr int gridColumns = 7, gridRows = 5;
constexpr double cellAcross = 0.02, cellDown = 0.03, density = 0.2;  // [m], [kg/m²]

// A sheet whose threads across bend ten times as hard as those down, and hardly at 45°.
Bending sheetOf10To1() {
    return gridBending(gridColumns, gridRows, *orthotropicRigidity(1e-4, 1e-5, 1.5e-5), cellAcross, cellDown);
}

std::vector<int> gridNumbers(int count, int first, int step) {
    std::vector<int> points(count);
    for (int i = 0; i < count; ++i) points[i] = first + step * i;
    return points;
}

// Of the sheet flat in the x-y plane, with points between its own where step is 2.
PlanarState<double> flatSheet(int step = 1) {
    std::vector<dvec3> x(gridColumns * gridRows * step, dvec3(7, 8, 9));
    for (int i = 0; i < gridColumns * gridRows; ++i)
        x[i * step] = {cellAcross * (i % gridColumns), -cellDown * (i / gridColumns), 0};
    return {x, std::vector<double>(x.size(), density * cellAcross * cellDown)};
}

TEST(GridBending, ForcesAreTheSlopeOfTheEnergyAndKeepMomentumAndAngularMomentum) {
    Bending bending = sheetOf10To1();
    ASSERT_LT(bending.both[gridColumns + 1], 0) << "the bias is so soft that both directions have to be coupled";
    const GridBending<double> generator(bending, gridNumbers(gridColumns * gridRows, 0, 1));
    PlanarState<double> state = flatSheet();
    state.shake(0.01, 0.0);
    const std::vector<dvec3> forces = state.forces(generator);
    dvec3 sum(0.0), torque(0.0);
    double size = 0;
    for (int i = 0; i < gridColumns * gridRows; ++i) {
        const dvec3 f = forces[i];
        sum += f;
        torque += glm::cross(state.get(state.x, i), f);
        size = std::max(size, glm::length(f));
    }
    // Rounding of a few hundred terms of that size.
    EXPECT_LT(glm::length(sum), 1e-13 * size);
    EXPECT_LT(glm::length(torque), 1e-14 * size);
    constexpr double h = 1e-5;  // quadratic: any step would do but for rounding of the energy
    for (const int i : {0, 8, 17, 34})
        for (int axis = 0; axis < 3; ++axis) {
            PlanarState<double> moved = state;
            moved.x[moved.index(i, axis)] += h;
            const double more = generator.potentialEnergy(moved.motion());
            moved.x[moved.index(i, axis)] -= 2 * h;
            const double less = generator.potentialEnergy(moved.motion());
            EXPECT_NEAR(forces[i][axis], -(more - less) / (2 * h), 1e-8 * size);
        }
}

TEST(GridBending, IsTheSameWhereverThePointsAreAndForEveryInstructionSet) {
    Bending bending = sheetOf10To1();
    bending.dampingTime = 1e-3;
    PlanarState<double> state = flatSheet(), apart = flatSheet(2);
    state.shake(0.01, 1.0);
    for (int i = 0; i < gridColumns * gridRows; ++i) {
        apart.set(apart.x, 2 * i, state.get(state.x, i));
        apart.set(apart.v, 2 * i, state.get(state.v, i));
    }
    std::vector<dvec3> expected;
    test::forEachInstructionSet([&] {
        const GridBending<double> near(bending, gridNumbers(gridColumns * gridRows, 0, 1));
        const GridBending<double> far(bending, gridNumbers(gridColumns * gridRows, 0, 2));
        const std::vector<dvec3> forces = state.forces(near), others = apart.forces(far);
        if (expected.empty()) expected = forces;
        EXPECT_EQ(forces, expected);
        for (std::size_t i = 0; i < forces.size(); ++i) EXPECT_EQ(others[2 * i], forces[i]) << i;
    });
}

// A cylinder about an axis at an angle to the threads, of such a curvature: its energy is ½ B(φ) κ² an area, with
// B(φ) = B_u c⁴ + B_v s⁴ + (2 B_1 + 4 D_k) c² s² = the given values at 0°, 90° and 45°.
TEST(GridBending, ASheetBentToACylinderHasTheRigidityThatWasMeasured) {
    constexpr int n = 41;
    constexpr double cell = 0.005, curvature = 0.5, side = cell * (n - 1);
    constexpr double inside = 1 - 1.0 / (n - 1);  // no fold stands at an edge
    for (const double bias : {1.5e-5, 6e-5}) {
        const BendingRigidity of = *orthotropicRigidity(1e-4, 1e-5, bias);
        const GridBending<double> generator(gridBending(n, n, of, cell, cell), gridNumbers(n * n, 0, 1));
        for (const auto& [degrees, rigidity] : {std::pair(0.0, 1e-4), std::pair(90.0, 1e-5), std::pair(45.0, bias)}) {
            const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
            std::vector<dvec3> x;
            for (int i = 0; i < n * n; ++i) {
                const double u = cell * (i % n), v = cell * (i / n), along = c * u + s * v, across = c * v - s * u;
                const double angle = curvature * along;
                x.emplace_back(std::sin(angle) / curvature, across, (1 - std::cos(angle)) / curvature);
            }
            const PlanarState<double> state(x, std::vector<double>(x.size(), 1.0));
            const double measured =
                generator.potentialEnergy(state.motion()) / (0.5 * curvature * curvature * side * side);
            const double missing = (1 - inside) * (of.along * c * c * c * c + of.across * s * s * s * s) +
                                   (1 - inside * inside) * 2 * of.both * c * c * s * s;
            // Differences over a cell are exact to (κ a)²/12, their squares to twice that: 1.04e-6.
            EXPECT_NEAR(measured + missing, rigidity, 1.1e-6 * rigidity) << degrees << "°, bias " << bias;
        }
    }
}

// Of an isotropic square sheet far from its edges ω² = 64 D/(ρ a⁴), of waves of two cells both ways.
TEST(GridBending, SharesItsExactTopFrequency) {
    constexpr int n = 24;
    constexpr double cell = 0.01, rigidity = 1e-5, mass = density * cell * cell;
    const GridBending<double> generator(gridBending(n, n, *orthotropicRigidity(rigidity, rigidity, {}), cell, cell),
                                        gridNumbers(n * n, 0, 1));
    std::vector<dvec3> x;
    for (int i = 0; i < n * n; ++i) x.emplace_back(cell * (i % n), cell * (i / n), 0);
    PlanarState<double> state(x, std::vector<double>(x.size(), mass));
    const StabilityShare share = state.stability(generator);
    const double top = 64 * rigidity / (density * cell * cell * cell * cell);
    EXPECT_NEAR(*std::max_element(share.stiffness.begin(), share.stiffness.end()) / mass, top, 1e-9 * top);
    core::AlignedArray<double> u(state.planes());
    for (int i = 0; i < n * n; ++i) u[state.index(i, 2)] = (i % n + i / n) % 2 == 0 ? 1 : -1;
    core::AlignedArray<double> out(state.planes());
    generator.addStiffnessProduct(state.motion(), u.data(), out.data());
    const int inside = 12 * n + 12;
    EXPECT_NEAR(out[state.index(inside, 2)] / u[state.index(inside, 2)] / mass, top, 1e-9 * top);
}

TEST(GridBending, ProductsForImplicitMethodsAreThoseOfStiffnessAndDamping) {
    Bending bending = sheetOf10To1();
    bending.dampingTime = 0.25;
    bending.clamps = {{3, 3 + gridColumns, {0, -cellDown, 0}, 2.0}};
    GridBending<double> generator(bending, gridNumbers(gridColumns * gridRows, 0, 1));
    PlanarState<double> state = flatSheet();
    state.shake(0.01, 0.0);
    core::AlignedArray<double> product(state.planes()), stiffness(state.planes()), diagonal(state.planes());
    generator.linearise(state.motion(), 3.0, 8.0);  // 3 + 0.25 · 8 times the stiffness
    generator.addProduct(state.stride, state.x.data(), product.data());
    generator.addStiffnessProduct(state.motion(), state.x.data(), stiffness.data());
    generator.addDiagonal(state.stride, diagonal.data());
    for (int i = 0; i < gridColumns * gridRows; ++i) {
        const std::size_t at = state.index(i, 1);
        EXPECT_NEAR(product[at], 5.0 * stiffness[at], 1e-12);  // numbers near 1
        core::AlignedArray<double> unit(state.planes()), column(state.planes());
        unit[at] = 1;
        generator.addProduct(state.stride, unit.data(), column.data());
        EXPECT_NEAR(diagonal[at], column[at], 1e-12);
    }
}

TEST(BendingRigidity, RefusesABiasForWhichNoEnergyIsPositive) {
    EXPECT_NEAR(leastBias(66.3e-6, 22.7e-6), 2.8528e-6, 1e-10);  // (8.14248 - 4.76445)²/4
    EXPECT_FALSE(orthotropicRigidity(66.3e-6, 22.7e-6, 2.84e-6));
    const auto softest = orthotropicRigidity(66.3e-6, 22.7e-6, 2.86e-6);
    ASSERT_TRUE(softest);
    EXPECT_GT(softest->twist, 0);
    EXPECT_LT(softest->both * softest->both, softest->along * softest->across);
    EXPECT_NEAR(4 * 2.86e-6, 66.3e-6 + 22.7e-6 + 2 * softest->both + softest->twist, 1e-18);
}

}  // namespace
}  // namespace taut::mechanics
