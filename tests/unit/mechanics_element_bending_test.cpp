#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mechanics_planar_state.h"
#include "taut/mechanics/bending.h"
#include "taut/mechanics/bending_elements.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/element_bending.h"

namespace taut::mechanics {
namespace {

using glm::dvec2;
using glm::dvec3;
using test::PlanarState;

constexpr int patchCells = 8;
constexpr double patchCell = 0.02;  // [m]

// A sheet of so many cells each way whose inner points are moved by up to `jitter` of a cell, in triangles whose
// diagonals alternate, laid into space by `place`. Its warp is at `warpDegrees` to x.
template <class Place>
Model patch(double jitter, const BendingRigidity& rigidity, double warpDegrees, const Place& place) {
    MeshClothShape shape;
    std::vector<dvec2> flat;
    std::uint32_t state = 7;
    const auto next = [&state] {
        state = state * 1664525U + 1013904223U;
        return static_cast<double>(state >> 8) / 0x800000 - 1.0;
    };
    constexpr int n = patchCells + 1;
    for (int i = 0; i < n * n; ++i) {
        dvec2 p(i % n, i / n);
        const dvec2 shift(next(), next());
        if (i % n > 0 && i % n < n - 1 && i / n > 0 && i / n < n - 1) p += jitter * shift;
        flat.push_back(patchCell * p);
        shape.positions.push_back(place(flat.back()));
    }
    const double c = std::cos(warpDegrees * M_PI / 180), s = std::sin(warpDegrees * M_PI / 180);
    const auto add = [&](int p, int q, int r) {
        shape.triangles.push_back({p, q, r});
        auto& uv = shape.cornerUv.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const dvec2 at = flat[shape.triangles.back()[k]];
            uv[k] = {c * at.x + s * at.y, c * at.y - s * at.x};
        }
    };
    for (int j = 0; j < patchCells; ++j)
        for (int i = 0; i < patchCells; ++i) {
            const int p = j * n + i;
            if ((i + j) % 2 == 0) {
                add(p, p + 1, p + n + 1);
                add(p, p + n + 1, p + n);
            } else {
                add(p, p + 1, p + n);
                add(p + 1, p + n + 1, p + n);
            }
        }
    shape.material.rigidity = rigidity;
    return buildMeshCloth(shape);
}

dvec3 flatPlace(dvec2 p) {
    return {p.x, p.y, 0};
}
// A saddle about as curved as it is wide.
dvec3 saddlePlace(dvec2 p) {
    return {p.x, p.y, 4 * p.x * p.x - 6 * p.y * p.y + 3 * p.x * p.y};
}

template <class Real = double>
ElementBending<Real> bendingOf(const Model& model) {
    std::vector<int> points(model.positions.size());
    std::iota(points.begin(), points.end(), 0);
    const std::vector<bool> none(points.size(), false);
    return {bendingElements(model, none, none, [](int, int) { return false; }), model.freeform.dampingTime, points};
}

const BendingRigidity threads = *orthotropicRigidity(1e-4, 1e-5, 1.5e-5);

Model curvedRing() {
    return buildRope({.start = {-0.1, 0, 0},
                      .end = {0.1, 0, 0},
                      .segments = 12,
                      .isClosed = true,
                      .rigidity = 1e-4,
                      .isCurvedAtRest = true});
}

double largest(const std::vector<dvec3>& forces) {
    double size = 0;
    for (const dvec3& f : forces) size = std::max(size, glm::length(f));
    return size;
}

TEST(ElementBending, ElementsCurvedAtRestAreFreeOfForceThere) {
    for (const Model& model : {patch(0.3, threads, 20, saddlePlace), curvedRing()}) {
        const auto generator = bendingOf(model);
        PlanarState<double> state(model);
        const double atRest = largest(state.forces(generator));
        state.shake(1e-3, 0);
        EXPECT_LT(atRest, 1e-12 * largest(state.forces(generator)));  // rounding of weights of 1/m²
        PlanarState<double> rest(model);
        EXPECT_LT(generator.potentialEnergy(rest.motion()), 1e-20 * generator.potentialEnergy(state.motion()));
    }
}

TEST(ElementBending, ForcesAreTheSlopeOfTheEnergyAndKeepMomentumAndAngularMomentum) {
    for (const Model& model : {patch(0.3, threads, 20, saddlePlace), curvedRing()}) {
        const auto generator = bendingOf(model);
        PlanarState<double> state(model);
        state.shake(4e-3, 0);
        const std::vector<dvec3> forces = state.forces(generator);
        dvec3 sum(0.0), torque(0.0);
        for (int i = 0; i < state.count; ++i) {
            sum += forces[i];
            torque += glm::cross(state.get(state.x, i), forces[i]);
        }
        const double size = largest(forces);
        // Rounding of a few thousand terms of that size, with arms of 0.1 m.
        EXPECT_LT(glm::length(sum), 1e-13 * size);
        EXPECT_LT(glm::length(torque), 1e-14 * size);
        constexpr double h = 1e-6;
        for (const int i : {0, 3, 11, state.count / 2})
            for (int axis = 0; axis < 3; ++axis) {
                PlanarState<double> moved = state;
                moved.x[moved.index(i, axis)] += h;
                const double more = generator.potentialEnergy(moved.motion());
                moved.x[moved.index(i, axis)] -= 2 * h;
                const double less = generator.potentialEnergy(moved.motion());
                // h² of the third derivative: (h over a cell)², times a few.
                EXPECT_NEAR(forces[i][axis], -(more - less) / (2 * h), 1e-7 * size);
            }
    }
}

// The patch test: in a sheet bent alike everywhere no force acts on a point whose elements see no border.
TEST(ElementBending, ABentSheetIsInEquilibriumOnAnyTriangulation) {
    const Model model = patch(0.3, threads, 20, flatPlace);
    const auto generator = bendingOf(model);
    PlanarState<double> state(model);
    for (int i = 0; i < state.count; ++i) {
        const dvec3 x = state.get(state.x, i);
        state.set(state.x, i, {x.x, x.y, 4 * x.x * x.x - 6 * x.y * x.y + 3 * x.x * x.y});
    }
    const std::vector<dvec3> forces = state.forces(generator);
    constexpr int n = patchCells + 1, middle = n / 2 * n + n / 2;
    EXPECT_LT(glm::length(forces[middle]), 1e-11 * largest(forces));  // of 30 terms that cancel
}

// Bent to a quadratic cylinder at an angle to the warp it has the energy of the rigidity asked for, B(φ) κ²/2 an area.
TEST(ElementBending, ASheetHasTheRigidityThatWasMeasuredAlongItsTextureCoordinates) {
    constexpr double curvature = 0.5, side = patchCell * patchCells;
    for (const auto& [degrees, rigidity] : {std::pair(0.0, 1e-4), std::pair(90.0, 1e-5), std::pair(45.0, 1.5e-5)}) {
        const Model model = patch(0.3, threads, degrees, flatPlace);
        const auto generator = bendingOf(model);
        PlanarState<double> state(model);
        for (int i = 0; i < state.count; ++i) {
            const dvec3 x = state.get(state.x, i);
            state.set(state.x, i, {x.x, x.y, 0.5 * curvature * x.x * x.x});
        }
        // A quadratic function is met exactly, also at borders.
        EXPECT_NEAR(generator.potentialEnergy(state.motion()), 0.5 * rigidity * curvature * curvature * side * side,
                    1e-9 * rigidity * curvature * curvature * side * side)
            << degrees;
    }
}

// The same of a grid whose warp is turned, bent along its lines across, at any angle to the warp: B(φ) of the fourth
// order in cosine and sine, with the coupling of bend and twist that keeps it from being a mean of warp and weft.
TEST(ElementBending, AGridWithATurnedGrainHasTheRigidityAtThatAngleToTheWarp) {
    constexpr double curvature = 0.5;
    for (const double degrees : {20.0, 45.0, -45.0, 110.0, 165.0}) {
        const double grain = degrees * M_PI / 180, c = std::cos(grain), s = std::sin(grain);
        const Model model =
            buildCloth({.size = {0.16, 0.15}, .cells = {8, 6}, .material = {.rigidity = threads}, .grain = grain});
        ASSERT_TRUE(model.bending.isEmpty());
        PlanarState<double> state(model);
        for (int i = 0; i < state.count; ++i) {
            const dvec3 x = state.get(state.x, i);
            state.set(state.x, i, {x.x, x.y, 0.5 * curvature * x.x * x.x});
        }
        const double rigidity = threads.along * c * c * c * c + threads.across * s * s * s * s +
                                (2 * threads.both + threads.twist) * c * c * s * s;
        EXPECT_NEAR(bendingOf(model).potentialEnergy(state.motion()),
                    0.5 * rigidity * curvature * curvature * 0.16 * 0.15,
                    1e-9 * rigidity * curvature * curvature * 0.16 * 0.15)
            << degrees;
        EXPECT_NEAR(rigidityAt(threads, grain), rigidity, 1e-15 * threads.along);
    }
}

TEST(ElementBending, ProductsForImplicitMethodsAreThoseOfStiffnessAndDamping) {
    for (Model model : {patch(0.3, threads, 20, saddlePlace), curvedRing()}) {
        model.freeform.dampingTime = 0.25;
        auto generator = bendingOf(model);
        PlanarState<double> state(model);
        core::AlignedArray<double> moved(state.planes()), product(state.planes()), diagonal(state.planes());
        generator.linearise(state.motion(), 3.0, 8.0);  // 3 + 0.25 · 8 times the stiffness
        generator.addDiagonal(state.stride, diagonal.data());
        PlanarState<double> shaken = state;
        shaken.shake(1e-7, 0);
        const std::vector<dvec3> forces = shaken.forces(generator);
        for (std::size_t i = 0; i < state.planes(); ++i) moved[i] = shaken.x[i] - state.x[i];
        generator.addProduct(state.stride, moved.data(), product.data());
        for (const int i : {0, 3, 11, state.count / 2})
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t at = state.index(i, axis);
                // At rest the stiffness is exact; the force of 1e-7 m is linear to 1e-7 over a cell.
                EXPECT_NEAR(product[at], -5.0 * forces[i][axis], 1e-4 * largest(forces));
                core::AlignedArray<double> unit(state.planes()), column(state.planes());
                unit[at] = 1;
                generator.addProduct(state.stride, unit.data(), column.data());
                EXPECT_NEAR(diagonal[at], column[at], 1e-12);  // numbers near 1
            }
    }
}

// Of a circle πEI/R; of n chords a, whose second differences are 2 a sin(π/n), 2 n EI sin²(π/n)/a.
TEST(ElementBending, ARingThatIsStraightAtRestHasTheEnergyOfItsCurvature) {
    constexpr int n = 24;
    const Model model =
        buildRope({.start = {-0.1, 0, 0}, .end = {0.1, 0, 0}, .segments = n, .isClosed = true, .rigidity = 1e-4});
    const double s = std::sin(M_PI / n), energy = 2 * n * 1e-4 * s * s / (2 * 0.1 * s);
    EXPECT_NEAR(bendingOf(model).potentialEnergy(PlanarState<double>(model).motion()), energy, 1e-12 * energy);
    EXPECT_NEAR(energy, M_PI * 1e-4 / 0.1, 3e-3 * energy);  // (π/n)²/6
}

TEST(ElementBending, SinglePrecisionIsThatOfDifferences) {
    Model model = patch(0.3, threads, 20, saddlePlace);
    const auto exact = bendingOf<double>(model);
    const auto rough = bendingOf<float>(model);
    PlanarState<double> state(model);
    PlanarState<float> rounded(model);
    for (int i = 0; i < state.count; ++i) {
        const dvec3 x = state.get(state.x, i) * 1.05;
        rounded.set(rounded.x, i, x);
        state.set(state.x, i, rounded.get(rounded.x, i));  // the same places
    }
    const std::vector<dvec3> forces = state.forces(exact), others = rounded.forces(rough);
    const StabilityShare share = state.stability(exact);
    for (std::size_t i = 0; i < forces.size(); ++i)
        EXPECT_LT(glm::length(forces[i] - others[i]), 0x1p-23 * share.stiffness[i] * patchCell) << i;  // of each term
}

}  // namespace
}  // namespace taut::mechanics
