#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mechanics_planar_state.h"
#include "taut/mechanics/bending.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/gravity.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/private/grid_bending.h"
#include "taut/mechanics/private/grid_friction.h"
#include "taut/ode/method_table.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using test::PlanarState;

constexpr int rubbingColumns = 6, rubbingRows = 4;
constexpr double rubbingAcross = 0.02, rubbingDown = 0.03;  // [m]

// M_y = 1e-3 N at 5 /m.
BendingFriction rubbing() {
    return {gridBending(rubbingColumns, rubbingRows, {2e-4, 2e-4, 0, 0}, rubbingAcross, rubbingDown), 5.0,
            {rubbingAcross, rubbingDown}, {0, 0, -1}};
}

std::vector<int> rubbingPoints() {
    std::vector<int> points(static_cast<std::size_t>(rubbingColumns * rubbingRows));
    std::iota(points.begin(), points.end(), 0);
    return points;
}

PlanarState<double> rubbingSheet() {
    std::vector<dvec3> x;
    for (int i = 0; i < rubbingColumns * rubbingRows; ++i)
        x.emplace_back(rubbingAcross * (i % rubbingColumns), -rubbingDown * (i / rubbingColumns), 0);
    return {x, std::vector<double>(x.size(), 1.0)};
}

// Some folds stick and some slip, some have a normal and some hardly any.
TEST(GridFriction, ForcesAreTheSlopeOfWhatIsStoredAndKeepMomentumAndAngularMomentum) {
    std::vector<double> sliders(GridFriction<double>::sliderCount(rubbing(), false));
    GridFriction<double> generator(rubbing(), rubbingPoints(), sliders);
    for (const double size : {1e-4, 0.002, 0.02}) {
        PlanarState<double> state = rubbingSheet();
        state.shake(size, 0.0);
        generator.slide(state.motion());
        state.shake(0.2 * size, 0.0);
        const std::vector<dvec3> forces = state.forces(generator);
        dvec3 sum(0.0), torque(0.0);
        double largest = 0;
        for (int i = 0; i < rubbingColumns * rubbingRows; ++i) {
            const dvec3 f = forces[static_cast<std::size_t>(i)];
            sum += f;
            torque += glm::cross(state.get(state.x, i), f);
            largest = std::max(largest, glm::length(f));
        }
        // Rounding of some hundred terms of that size, at most 0.1 m from the origin.
        EXPECT_LT(glm::length(sum), 1e-13 * largest) << size;
        EXPECT_LT(glm::length(torque), 1e-14 * largest) << size;
        constexpr double h = 1e-8;  // [m]
        for (int i = 0; i < rubbingColumns * rubbingRows; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                PlanarState<double> moved = state;
                moved.x[moved.index(i, axis)] += h;
                const double more = generator.potentialEnergy(moved.motion());
                moved.x[moved.index(i, axis)] -= 2 * h;
                const double slope = (more - generator.potentialEnergy(moved.motion())) / (2 * h);
                // What slips pulls on, though it stores no more: there the slope is that of the part that sticks.
                if (size == 1e-4) EXPECT_NEAR(forces[static_cast<std::size_t>(i)][axis], -slope, 1e-5 * largest) << i;
            }
    }
}

}  // namespace
}  // namespace taut::mechanics
