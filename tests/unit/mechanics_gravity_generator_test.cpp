#include <gtest/gtest.h>

#include "mechanics_planar_state.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/gravity.h"

namespace taut::mechanics {
namespace {

using test::PlanarState;

TEST(Gravity, IsTheWeightOfEachPoint) {
    RopeShape shape;
    shape.segments = 4;
    PlanarState<float> state(buildRope(shape));
    const Gravity<float> gravity({0.5, -9.81, 0.0});
    const std::vector<glm::dvec3> forces = state.forces(gravity);
    for (int i = 0; i < state.count; ++i) {
        const double m = state.mass[i];
        const glm::dvec3 f = forces[i];
        EXPECT_NEAR(f.x, 0.5 * m, 1e-6 * m);  // float rounding, 6e-8, of a product
        EXPECT_NEAR(f.y, -9.81 * m, 1e-5 * m);
        EXPECT_EQ(f.z, 0.0);
    }
}

TEST(Gravity, AddsToPartOfThePoints) {
    RopeShape shape;
    shape.segments = 4;
    PlanarState<double> state(buildRope(shape));
    const Gravity<double> gravity({0.0, -10.0, 0.0});
    state.f[state.index(2, 1)] = 100.0;
    gravity.addForces(state.motion(), 1, 3, state.f.data());
    EXPECT_EQ(state.f[state.index(0, 1)], 0.0);
    EXPECT_EQ(state.f[state.index(1, 1)], -10.0 * 0.25);
    EXPECT_EQ(state.f[state.index(2, 1)], 100.0 - 10.0 * 0.25);
    EXPECT_EQ(state.f[state.index(3, 1)], 0.0);
    EXPECT_TRUE(gravity.isLocal());
}

TEST(Gravity, EnergyFallsByWeightTimesHeight) {
    RopeShape shape;
    shape.mass = 3.0;
    PlanarState<double> state(buildRope(shape));
    const Gravity<double> gravity({0.0, -9.81, 0.0});
    const double before = gravity.potentialEnergy(state.motion());
    for (int i = 0; i < state.count; ++i) state.x[state.index(i, 1)] -= 2.0;
    EXPECT_NEAR(gravity.potentialEnergy(state.motion()) - before, -3.0 * 9.81 * 2.0, 1e-12);  // 21 terms, rounding
}

}  // namespace
}  // namespace taut::mechanics
