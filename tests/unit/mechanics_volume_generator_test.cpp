#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "mechanics_planar_state.h"
#include "support/eigenvalues.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/cell_shape.h"
#include "taut/mechanics/private/volume.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using test::PlanarState;
using test::sum;

Model block(int cells) {
    BlockShape shape;
    shape.cells = glm::ivec3(cells);
    shape.bulk = 2e4;
    return buildBlock(shape);
}

// A cell of 1 m³.
Model cube() {
    BlockShape shape;
    shape.cells = glm::ivec3(1);
    shape.bulk = 600.0;
    shape.centre = dvec3(0.5);
    return buildBlock(shape);
}

VolumePreservation<double> generatorOf(const Model& model, double workingStretch = 1.5) {
    return {model.cells, model.positions, workingStretch};
}

void scale(PlanarState<double>& state, const dvec3& factors) {
    for (int i = 0; i < state.count; ++i)
        for (int axis = 0; axis < 3; ++axis) state.x[state.index(i, axis)] *= factors[axis];
}

// K = -∂f/∂x column by column, with the masses' roots divided out if asked.
taut::test::Matrix stiffnessMatrix(const PlanarState<double>& state, const VolumePreservation<double>& volume) {
    const auto n = static_cast<std::size_t>(3 * state.count);
    taut::test::Matrix matrix(n);
    for (std::size_t column = 0; column < n; ++column) {
        core::AlignedArray<double> u(state.planes()), out(state.planes());
        u[state.index(static_cast<int>(column / 3), static_cast<int>(column % 3))] = 1.0;
        volume.addStiffnessProduct(state.motion(), u.data(), out.data());
        for (std::size_t row = 0; row < n; ++row)
            matrix.at(row, column) = out[state.index(static_cast<int>(row / 3), static_cast<int>(row % 3))];
    }
    return matrix;
}

int foldsOf(const Model& model, const PlanarState<double>& state) {
    int folds = 0;
    for (const VolumeCell& cell : model.cells)
        forEachFold(cornersOf(cell, state.x.data(), state.motion().stride), cell.restVolume,
                    [&](const Fold&) { ++folds; });
    return folds;
}

TEST(Volume, AtRestHasNoForceAndNoEnergy) {
    const Model model = block(3);
    PlanarState<double> state(model);
    const VolumePreservation<double> volume = generatorOf(model);
    // K · area · 1e-16 · a few cells.
    for (const dvec3& f : state.forces(volume)) EXPECT_LT(glm::length(f), 1e-10);
    EXPECT_NEAR(volume.potentialEnergy(state.motion()), 0.0, 1e-20);
}

// V/V0 is the same everywhere under a uniform strain, so that E = ½ K V0 (V/V0 - 1)² for the whole block.
TEST(Volume, UniformStrainStoresTheMaterialsEnergyAtEveryResolution) {
    for (int cells : {1, 2, 4}) {
        const Model model = block(cells);
        PlanarState<double> state(model);
        scale(state, {1.1, 0.95, 1.02});
        const double change = 1.1 * 0.95 * 1.02 - 1.0;
        EXPECT_NEAR(generatorOf(model).potentialEnergy(state.motion()), 0.5 * 2e4 * change * change, 1e-9);
    }
}

TEST(Volume, ForcesPassNeitherMomentumNorSpin) {
    const Model model = block(3);
    PlanarState<double> state(model);
    state.shake(0.1, 0.0);
    const std::vector<dvec3> forces = state.forces(generatorOf(model));
    dvec3 torque(0.0);
    double size = 0.0;
    for (int i = 0; i < state.count; ++i) {
        torque += glm::cross(state.get(state.x, i), forces[i]);
        size += glm::length(forces[i]);
    }
    EXPECT_GT(size, 1000.0);
    EXPECT_LT(glm::length(sum(forces)), 1e-13 * size);  // rounding of some hundred terms
    EXPECT_LT(glm::length(torque), 1e-13 * size);
}

TEST(Volume, ForceIsTheSlopeOfTheEnergy) {
    const Model model = cube();
    for (const double shake : {0.2, 0.8}) {
        PlanarState<double> state(model);
        state.shake(shake, 0.0);
        EXPECT_EQ(foldsOf(model, state) > 0, shake > 0.5);
        const VolumePreservation<double> volume = generatorOf(model);
        const std::vector<dvec3> forces = state.forces(volume);
        const double h = 1e-5;
        for (int i = 0; i < 8; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                double& x = state.x[state.index(i, axis)];
                const double here = x;
                x = here + h;
                const double up = volume.potentialEnergy(state.motion());
                x = here - h;
                const double down = volume.potentialEnergy(state.motion());
                x = here;
                // Quadratic in one coordinate, so no error of order h²; rounding of some hundred joules, 1e-13 J / h.
                EXPECT_NEAR(forces[i][axis], (down - up) / (2.0 * h), 3e-8);
            }
    }
}

TEST(Volume, StiffnessProductIsTheSlopeOfTheForce) {
    const Model model = block(2);
    for (const double shake : {0.15, 0.3}) {
        PlanarState<double> state(model);
        state.shake(shake, 0.0);
        EXPECT_EQ(foldsOf(model, state) > 0, shake > 0.2);
        const VolumePreservation<double> volume = generatorOf(model);
        PlanarState<double> direction(model);
        std::fill(direction.x.begin(), direction.x.end(), 0.0);
        direction.shake(1.0, 0.0);
        core::AlignedArray<double> product(state.planes());
        volume.addStiffnessProduct(state.motion(), direction.x.data(), product.data());
        const double h = 1e-6;
        auto forcesAt = [&](double s) {
            PlanarState<double> moved = state;
            for (std::size_t k = 0; k < moved.x.size(); ++k) moved.x[k] += s * direction.x[k];
            return moved.forces(volume);
        };
        const std::vector<dvec3> up = forcesAt(h), down = forcesAt(-h);
        for (int i = 0; i < state.count; ++i) {
            const auto p = static_cast<std::size_t>(i);
            // Rounding of forces near 1e4 N: 1e-12 / h; the cubic term: h² · 1e4.
            EXPECT_LT(glm::length(state.get(product, i) - (down[p] - up[p]) / (2.0 * h)), 1e-4);
        }
    }
}

TEST(Volume, StiffnessMatrixIsSymmetric) {
    const Model model = block(1);
    PlanarState<double> state(model);
    state.shake(0.2, 0.0);
    const taut::test::Matrix matrix = stiffnessMatrix(state, generatorOf(model));
    for (std::size_t i = 0; i < matrix.n; ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_NEAR(matrix.at(i, j), matrix.at(j, i), 1e-9);
}

// Gauss's rule with two places along each axis is exact: along an axis the determinant is of degree two.
TEST(Volume, OfACellIsThatOfItsTrilinearMap) {
    const Model model = cube();
    PlanarState<double> state(model);
    state.shake(0.4, 0.0);
    const CellCorners p = cornersOf(model.cells[0], state.x.data(), state.motion().stride);
    double volume = 0.0;
    for (int place = 0; place < 8; ++place) {
        glm::dmat3 slope(0.0);
        for (int corner = 0; corner < 8; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                double part = 1.0;
                for (int other = 0; other < 3; ++other) {
                    const double at = 0.5 + ((place >> other & 1) != 0 ? 0.5 : -0.5) / std::sqrt(3.0);
                    const bool isFar = (corner >> other & 1) != 0;
                    part *= other == axis ? (isFar ? 1.0 : -1.0) : (isFar ? at : 1.0 - at);
                }
                slope[axis] += part * p[corner];
            }
        volume += glm::determinant(slope) / 8.0;
    }
    EXPECT_NEAR(volumeOf(p), volume, 1e-14);
}

// A cube whose far face is turned about its own axis, or whose two ends are turned against each other as by bending.
TEST(Volume, HasNoForceInBendingAndTwistToFirstOrder) {
    const Model model = cube();
    const double h = 1e-6;
    for (int axis = 0; axis < 3; ++axis)
        for (const auto& [of, by] : {std::pair{1, 2}, std::pair{0, 1}, std::pair{0, 2}}) {
            PlanarState<double> state(model);
            for (int i = 0; i < 8; ++i) {
                const dvec3 x = 2.0 * state.get(state.x, i) - 1.0;
                state.x[state.index(i, axis)] += h * x[of] * x[by];
            }
            // K · area · h², and rounding.
            for (const dvec3& f : state.forces(generatorOf(model))) EXPECT_LT(glm::length(f), 2e-9);
        }
}

// The couplings that bounds use, against products with unit vectors. Without pressure they are K/V0 g gᵀ alone.
TEST(Volume, PairsOfCornersAreThoseThatTheVolumeCouples) {
    const Model model = cube();
    PlanarState<double> state(model);
    state.shake(0.3, 0.0);
    const CellCorners p = cornersOf(model.cells[0], state.x.data(), state.motion().stride);
    std::array<std::array<dvec3, 8>, 8> coupling{};
    for (const CellPair& pair : cellPairs) {
        coupling[pair.i][pair.j] = pair.coupling(p);
        coupling[pair.j][pair.i] = -pair.coupling(p);
    }
    for (std::size_t j = 0; j < 8; ++j)
        for (int axis = 0; axis < 3; ++axis) {
            CellCorners unit{};
            unit[j][axis] = 1.0;
            const CellCorners change = gradientsChange(p, unit);
            for (std::size_t i = 0; i < 8; ++i)
                EXPECT_LT(glm::length(change[i] - glm::cross(coupling[i][j], unit[j])), 1e-15);
        }
}

TEST(Volume, FlattenedOrMirroredCellIsPushedBack) {
    const Model model = cube();
    for (double height : {0.5, 0.0, -0.3, -1.0, -2.0}) {
        PlanarState<double> state(model);
        scale(state, {1.0, 1.0, height});
        const std::vector<dvec3> forces = state.forces(generatorOf(model));
        // V/V0 = height: F = K (1 - height) · area upwards on the four corners above, and K |height| · area once more
        // by the tetrahedra, which are all turned inside out below 0.
        const double above = forces[4].z + forces[5].z + forces[6].z + forces[7].z;
        EXPECT_NEAR(above, 600.0 * (1.0 - height - std::min(height, 0.0)), 1e-10);
    }
}

TEST(Volume, CollapsedToALineHasNoForceButIsReported) {
    const Model model = cube();
    PlanarState<double> state(model);
    scale(state, {1.0, 0.0, 0.0});
    const VolumePreservation<double> volume = generatorOf(model);
    for (const dvec3& f : state.forces(volume)) EXPECT_EQ(f, dvec3(0.0));
    const VolumeReport report = volume.inspect(state.motion());
    EXPECT_EQ(report.smallestRatio, 0.0);
    EXPECT_EQ(report.collapsed, 1);
    EXPECT_EQ(report.inverted, 1);
    EXPECT_EQ(report.overstretched, 0);
}

TEST(Volume, ReportCountsCollapsedInvertedAndOverstretched) {
    const Model model = block(2);
    PlanarState<double> state(model);
    const VolumePreservation<double> volume = generatorOf(model);
    VolumeReport report = volume.inspect(state.motion());
    EXPECT_NEAR(report.smallestRatio, 1.0, 1e-14);  // rounding of 1/8 m edges
    EXPECT_EQ(report.collapsed + report.inverted + report.overstretched, 0);

    scale(state, {1.0, 0.05, 1.0});
    report = volume.inspect(state.motion());
    EXPECT_NEAR(report.smallestRatio, 0.05, 1e-14);
    EXPECT_EQ(report.collapsed, 8);
    EXPECT_EQ(report.inverted, 0);

    scale(state, {1.0, -20.0, 1.0});
    report = volume.inspect(state.motion());
    EXPECT_EQ(report.inverted, 8);
    EXPECT_EQ(report.overstretched, 0);

    scale(state, {1.6, -1.0, 1.0});
    EXPECT_EQ(volume.inspect(state.motion()).overstretched, 8);
    scale(state, {1.5 / 1.6, 1.5, 1.0});
    EXPECT_EQ(volume.inspect(state.motion()).overstretched, 0);

    // One corner alone: the smallest cell is one that has it.
    PlanarState<double> poked(model);
    poked.set(poked.x, 0, {-0.1, -0.1, -0.1});
    report = volume.inspect(poked.motion());
    const auto& points = model.cells[report.smallestCell].points;
    EXPECT_EQ(std::count(points.begin(), points.end(), 0), 1);
}

template <class Real>
void expectSameVolumeBits(double shake) {
    Model model = block(7);
    const std::size_t regular = model.cells.size();
    for (std::size_t k = 0; k < 100; ++k) model.cells.push_back(model.cells[(k * 97) % regular]);
    PlanarState<Real> state(model);
    state.shake(shake, 0.0);
    core::AlignedArray<Real> first;
    test::forEachInstructionSet([&] {
        state.forces(VolumePreservation<Real>(model.cells, model.positions));
        if (first.empty()) first = state.f;
        EXPECT_EQ(std::memcmp(first.data(), state.f.data(), first.size() * sizeof(Real)), 0)
            << core::nameOf(core::instructionSet());
    });
}

TEST(Volume, HasTheSameBitsForEveryInstructionSet) {
    for (const double shake : {0.02, 0.2}) {  // without and with tetrahedra turned inside out
        expectSameVolumeBits<float>(shake);
        expectSameVolumeBits<double>(shake);
    }
}

TEST(Volume, OrderOfCellsMattersOnlyInRounding) {
    const Model model = block(5);
    PlanarState<double> state(model);
    state.shake(0.05, 0.0);
    std::vector<VolumeCell> mixed;
    const std::size_t n = model.cells.size();
    ASSERT_NE(n % 7, 0U);
    for (std::size_t k = 0; k < n; ++k) mixed.push_back(model.cells[7 * k % n]);
    const std::vector<dvec3> f = state.forces(generatorOf(model));
    const std::vector<dvec3> g = state.forces(VolumePreservation<double>(mixed, model.positions));
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_LT(glm::length(f[i] - g[i]), 1e-10);  // forces of 1e3 N
}

}  // namespace
}  // namespace taut::mechanics
