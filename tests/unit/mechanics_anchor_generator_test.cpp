#include <gtest/gtest.h>

#include "mechanics_planar_state.h"
#include "taut/mechanics/private/anchor.h"

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
    for (int i = 0; i < 3; ++i) EXPECT_EQ(state.get(state.f, i), whole[i]);
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
            EXPECT_NEAR(f[i][axis], (down - up) / (2.0 * h), 1e-11);
            u[state.index(i, axis)] = 1.0 + i;
        }
    anchor.addStiffnessProduct(state.motion(), u.data(), product.data());
    EXPECT_EQ(product[state.index(0, 0)], 7.0);
    EXPECT_EQ(product[state.index(1, 0)], 0.0);
    EXPECT_EQ(product[state.index(2, 2)], 21.0);
}

// A point 5 m away on a spring of 10 N/m, and one 0.5 m away on the same: 8 N at most.
constexpr double mostForce = 8.0;
const std::vector<dvec3> farAndNear = {{3.0, 4.0, 0.0}, {0.0, 0.0, 0.5}};
const std::vector<double> twoMasses = {1.0, 1.0};

Anchor<double> cutAnchor(double damping) {
    return {{0, 1}, {0, 0, 0}, {10.0, 10.0}, {damping, damping}, {}, {mostForce, mostForce}};
}

TEST(Anchor, PullsNoHarderThanItsLargestForce) {
    PlanarState<double> state(farAndNear, twoMasses);
    const std::vector<dvec3> f = state.forces(cutAnchor(0.0));
    EXPECT_NEAR(glm::length(f[0] - dvec3(-4.8, -6.4, 0.0)), 0.0, anchorRounding);  // 8 N along (3, 4, 0)
    EXPECT_EQ(f[1], dvec3(0.0, 0.0, -5.0));                                        // as without
    // The dashpot's force counts: 50 N along and 30 N across, cut to 8 N in the same direction.
    state.set(state.v, 0, {0.0, 0.0, 10.0});
    EXPECT_NEAR(glm::length(state.forces(cutAnchor(3.0))[0]), mostForce, anchorRounding);
}

TEST(Anchor, ForceAndStiffnessAreSlopesOfItsEnergyWhereItIsCut) {
    PlanarState<double> state(farAndNear, twoMasses);
    Anchor<double> anchor = cutAnchor(0.0);
    // 8 N from 0.8 m on, 3.2 J up to there; and 10 N/m · (0.5 m)² / 2.
    EXPECT_NEAR(anchor.potentialEnergy(state.motion()), 3.2 + 8.0 * 4.2 + 1.25, 1e-12);
    const std::vector<dvec3> f = state.forces(anchor);
    anchor.linearise(state.motion(), 1.0, 0.0);
    core::AlignedArray<double> diagonal(state.planes());
    anchor.addDiagonal(state.stride, diagonal.data());
    for (int i = 0; i < 2; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            double& x = state.x[state.index(i, axis)];
            const double h = 1e-4, here = x;
            x = here + h;
            const double up = anchor.potentialEnergy(state.motion());
            const std::vector<dvec3> forceUp = state.forces(anchor);
            x = here - h;
            const double down = anchor.potentialEnergy(state.motion());
            const std::vector<dvec3> forceDown = state.forces(anchor);
            x = here;
            // Differences err by h² of third derivatives, 8 N / (5 m)², and by rounding, 4e-15 · 38 J / h.
            EXPECT_NEAR(f[i][axis], (down - up) / (2.0 * h), 1e-8);
            core::AlignedArray<double> u(state.planes()), product(state.planes()), weighted(state.planes());
            u[state.index(i, axis)] = 1.0;
            anchor.addStiffnessProduct(state.motion(), u.data(), product.data());
            anchor.addProduct(state.stride, u.data(), weighted.data());
            const auto slope = (forceDown[i] - forceUp[i]) / (2 * h);
            for (int other = 0; other < 3; ++other) {
                EXPECT_NEAR(product[state.index(i, other)], slope[other], 1e-8);
                EXPECT_EQ(weighted[state.index(i, other)], product[state.index(i, other)]);
            }
            EXPECT_NEAR(diagonal[state.index(i, axis)], slope[axis], 1e-8);
        }
}

// Springs of 2 m and 0.1 m: 5 m and 0.5 m long they pull 30 N and 4 N, along them with their dashpots.
TEST(Anchor, OfALengthPullsBeyondItAlongItsLine) {
    PlanarState<double> state(farAndNear, twoMasses);
    Anchor<double> anchor({0, 1}, {0, 0, 0}, {10.0, 10.0}, {3.0, 0.0}, {}, {}, {2.0, 0.1});
    EXPECT_NEAR(anchor.potentialEnergy(state.motion()), 0.5 * 10 * (9 + 0.16), 1e-12);
    const std::vector<dvec3> f = state.forces(anchor);
    EXPECT_NEAR(glm::length(f[0] - dvec3(-18.0, -24.0, 0.0)), 0.0, anchorRounding);
    EXPECT_NEAR(glm::length(f[1] - dvec3(0.0, 0.0, -4.0)), 0.0, anchorRounding);
    state.set(state.v, 0, {-4.0, 3.0, 1.0});  // across
    EXPECT_NEAR(glm::length(state.forces(anchor)[0] - f[0]), 0.0, anchorRounding);
    state.set(state.v, 0, {0.6, 0.8, 0.0});
    EXPECT_NEAR(glm::length(state.forces(anchor)[0] - f[0] + dvec3(1.8, 2.4, 0.0)), 0.0, anchorRounding);
    state.set(state.v, 0, {0.0, 0.0, 0.0});
    // k n nᵀ + k (1 - L/d)(1 - n nᵀ) is the slope of the force; with the dashpot also c n nᵀ.
    anchor.linearise(state.motion(), 1.0, 0.5);
    core::AlignedArray<double> diagonal(state.planes());
    anchor.addDiagonal(state.stride, diagonal.data());
    for (int axis = 0; axis < 3; ++axis) {
        core::AlignedArray<double> u(state.planes()), product(state.planes()), weighted(state.planes());
        u[state.index(0, axis)] = 1.0;
        anchor.addStiffnessProduct(state.motion(), u.data(), product.data());
        anchor.addProduct(state.stride, u.data(), weighted.data());
        EXPECT_NEAR(weighted[state.index(0, axis)], diagonal[state.index(0, axis)], 1e-14);
        const dvec3 along(0.6, 0.8, 0.0);
        double& x = state.x[state.index(0, axis)];
        const double h = 1e-4, here = x;
        x = here + h;
        const dvec3 up = state.forces(anchor)[0];
        x = here - h;
        const dvec3 slope = (state.forces(anchor)[0] - up) / (2 * h);
        x = here;
        for (int other = 0; other < 3; ++other) {
            EXPECT_NEAR(product[state.index(0, other)], slope[other], 1e-7);
            EXPECT_NEAR(weighted[state.index(0, other)], slope[other] + 0.5 * 3.0 * along[axis] * along[other], 1e-7);
        }
    }
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
