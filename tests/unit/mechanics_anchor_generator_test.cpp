#include <gtest/gtest.h>

#include "taut/mechanics/private/anchor.h"
#include "mechanics_planar_state.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using test::PlanarState;

// Values a few units large: double rounding of sums of three or four of them.
constexpr double anchorRounding = 1e-13;

const std::vector<dvec3> threePlaces = {{0, 0, 0}, {1, 2, 3}, {-1, 0.5, 0}};
const std::vector<double> threeMasses = {1.0, 0.5, 0.25};

TEST(Anchor, PullsItsPointsToThePlaceAndNoOthers) {
    PlanarState<double> state(threePlaces, threeMasses);
    const Anchor<double> anchor({2, 1}, {1.0, 1.0, 1.0}, 10.0, 0.0);
    const std::vector<dvec3> f = state.forces(anchor);
    EXPECT_EQ(f[0], dvec3(0.0));
    EXPECT_EQ(f[1], dvec3(0.0, -10.0, -20.0));
    EXPECT_EQ(f[2], dvec3(20.0, 5.0, 10.0));
    EXPECT_EQ(anchor.points(), (std::vector<int>{1, 2}));
}

TEST(Anchor, OffsetsKeepPointsApart) {
    PlanarState<double> state(threePlaces, threeMasses);
    const Anchor<double> anchor({2, 1}, {0.0, 0.0, 0.0}, 10.0, 1.0, {threePlaces[2], threePlaces[1]});
    for (const dvec3& f : state.forces(anchor)) EXPECT_EQ(f, dvec3(0.0));
}

TEST(Anchor, DampingResistsMotionRelativeToTheMovingPlace) {
    PlanarState<double> state(threePlaces, threeMasses);
    Anchor<double> anchor({1}, threePlaces[1], 0.0, 4.0);
    anchor.setPlace({0, 0, 0}, {3, 0, 0}, 1.0, 2.5);  // 2 m/s
    state.set(state.v, 1, {0.5, 1.0, 0.0});
    EXPECT_NEAR(glm::length(state.forces(anchor, 2.0)[1] - dvec3(6.0, -4.0, 0.0)), 0.0, anchorRounding);
    EXPECT_NEAR(glm::length(state.forces(anchor, 0.5)[1] - dvec3(-2.0, -4.0, 0.0)), 0.0, anchorRounding);
    EXPECT_NEAR(glm::length(state.forces(anchor, 2.5)[1] - dvec3(-2.0, -4.0, 0.0)), 0.0, anchorRounding);
}

TEST(Anchor, PlaceMovesEvenlyBetweenItsTimes) {
    Anchor<double> anchor({0}, {9, 9, 9}, 1.0, 0.0);
    EXPECT_EQ(anchor.place(7.0), dvec3(9, 9, 9));
    anchor.setPlace({0, 0, 0}, {4, 0, -2}, 1.0, 3.0);
    EXPECT_EQ(anchor.place(0.0), dvec3(0, 0, 0));
    EXPECT_EQ(anchor.place(1.5), dvec3(1, 0, -0.5));
    EXPECT_EQ(anchor.place(3.0), dvec3(4, 0, -2));
    anchor.setPlace({0, 0, 0}, {1, 1, 1}, 2.0, 2.0);  // a leap
    EXPECT_EQ(anchor.place(1.99), dvec3(0, 0, 0));
    EXPECT_EQ(anchor.place(2.0), dvec3(1, 1, 1));
}

TEST(Anchor, PartsAddUpToTheWhole) {
    PlanarState<double> state(threePlaces, threeMasses);
    const Anchor<double> anchor({0, 1, 2}, {0.3, 0.4, 0.5}, 7.0, 2.0);
    const std::vector<dvec3> whole = state.forces(anchor);
    std::fill(state.f.begin(), state.f.end(), 0.0);
    anchor.addForces(state.motion(), 0, 1, state.f.data());
    anchor.addForces(state.motion(), 1, 3, state.f.data());
    for (int i = 0; i < 3; ++i) EXPECT_EQ(state.get(state.f, i), whole[static_cast<std::size_t>(i)]);
}

TEST(Anchor, ForceAndStiffnessAreSlopesOfItsEnergy) {
    PlanarState<double> state(threePlaces, threeMasses);
    const Anchor<double> anchor({0, 2}, {0.3, 0.4, 0.5}, 7.0, 0.0, {{0.1, 0, 0}, {0, 0.2, 0}});
    const std::vector<dvec3> f = state.forces(anchor);
    core::AlignedArray<double> u(state.planes()), product(state.planes());
    for (int i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            double& x = state.x[state.index(i, axis)];
            const double h = 1e-3, here = x;
            x = here + h;
            const double up = anchor.potentialEnergy(state.motion());
            x = here - h;
            const double down = anchor.potentialEnergy(state.motion());
            x = here;
            // The energy is quadratic: the difference is exact but for rounding, 1e-15 / h.
            EXPECT_NEAR(f[static_cast<std::size_t>(i)][axis], (down - up) / (2.0 * h), 1e-11);
            u[state.index(i, axis)] = 1.0 + i;
        }
    anchor.addStiffnessProduct(state.motion(), u.data(), product.data());
    EXPECT_EQ(product[state.index(0, 0)], 7.0);
    EXPECT_EQ(product[state.index(1, 0)], 0.0);
    EXPECT_EQ(product[state.index(2, 2)], 21.0);
}

TEST(Anchor, SharesItsStiffnessAndDampingRate) {
    const PlanarState<float> state(threePlaces, threeMasses);
    const Anchor<float> anchor({1}, {0, 0, 0}, 10.0, 3.0);
    const StabilityShare share = state.stability(anchor);
    EXPECT_EQ(share.stiffness, (std::vector<double>{0.0, 10.0, 0.0}));
    EXPECT_EQ(share.dampingRate, (std::vector<double>{0.0, 6.0, 0.0}));
}

}  // namespace
}  // namespace taut::mechanics
