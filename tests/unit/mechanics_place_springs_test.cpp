#include <gtest/gtest.h>

#include "mechanics_planar_state.h"
#include "taut/mechanics/private/place_springs.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using test::PlanarState;

// From a place between points 0, 1 and 2, outside of them, to point 3; the same to a place that moves; and one of no
// length.
std::vector<PlaceSpring> threeSprings() {
    const std::vector<PlaceSpring::Share> place = {{0, 0.8}, {1, 0.6}, {2, -0.4}};
    PlaceSpring toPoint{place, {}, 10.0, 3.0, 0.5}, toPlace{place, {}, 7.0, 2.0, 4.0}, ofNone{place, {}, 5.0, 1.0, 0.0};
    toPoint.shares.push_back({3, -1.0});
    toPlace.second = ofNone.second = [](double t) { return PlaceSpring::Place{{2.0 + t, 0.5, -1.0}, {1.0, 0.0, 0.0}}; };
    return {toPoint, toPlace, ofNone};
}

const std::vector<dvec3> fourPlaces = {{0, 0, 0}, {1, 0.2, 0.3}, {-1, 0.5, 0}, {0.4, 2.0, -0.3}};
const std::vector<double> fourMasses = {1.0, 0.5, 0.25, 2.0};

// Both ends get the same force, at the places where they are.
TEST(PlaceSprings, PullBothEndsAlongTheirLine) {
    PlanarState<double> state(fourPlaces, fourMasses);
    state.shake(0.0, 1.0);
    const std::vector<dvec3> f = state.forces(PlaceSprings<double>({threeSprings()[0]}));
    dvec3 sum(0.0), moment(0.0);
    for (std::size_t i = 0; i < f.size(); ++i) {
        sum += f[i];
        moment += glm::cross(fourPlaces[i], f[i]);
    }
    // Rounding of a few terms of some 10 N.
    EXPECT_LT(glm::length(sum), 1e-13);
    EXPECT_LT(glm::length(moment), 1e-13);
    const dvec3 place(0.6 + 0.4, 0.12 - 0.2, 0.18), d = place - fourPlaces[3], n = glm::normalize(d);
    const auto speed = [&](int i) { return state.get(state.v, i); };
    const dvec3 rate = 0.8 * speed(0) + 0.6 * speed(1) - 0.4 * speed(2) - speed(3);
    EXPECT_LT(glm::length(f[3] - (10.0 * (glm::length(d) - 0.5) + 3.0 * glm::dot(rate, n)) * n), 1e-13);
}

// One of the three is shorter than its length, where slopes for implicit methods leave a part out.
TEST(PlaceSprings, ForcesAndProductsAreSlopesOfTheirEnergy) {
    for (std::size_t number = 0; number < 3; ++number) {
        PlanarState<double> state(fourPlaces, fourMasses);
        PlaceSpring undamped = threeSprings()[number];
        undamped.damping = 0;  // the place moves
        PlaceSprings<double> springs({undamped});
        const bool isShort = number == 1;
        const std::vector<dvec3> f = state.forces(springs);
        springs.linearise(state.motion(), 1.0, 0.0);
        core::AlignedArray<double> diagonal(state.planes());
        springs.addDiagonal(state.stride, diagonal.data());
        for (int i = 0; i < 4; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                double& x = state.x[state.index(i, axis)];
                const double h = 1e-4, here = x;
                x = here + h;
                const double up = springs.potentialEnergy(state.motion());
                const std::vector<dvec3> forceUp = state.forces(springs);
                x = here - h;
                const double down = springs.potentialEnergy(state.motion());
                const std::vector<dvec3> forceDown = state.forces(springs);
                x = here;
                // Differences err by h² of third derivatives, some 10 N/m² · h², and by rounding, 1e-14 J / h.
                EXPECT_NEAR(f[static_cast<std::size_t>(i)][axis], (down - up) / (2 * h), 1e-6);
                core::AlignedArray<double> u(state.planes()), product(state.planes()), weighted(state.planes());
                u[state.index(i, axis)] = 1.0;
                springs.addStiffnessProduct(state.motion(), u.data(), product.data());
                springs.addProduct(state.stride, u.data(), weighted.data());
                EXPECT_NEAR(diagonal[state.index(i, axis)], weighted[state.index(i, axis)], 1e-13);
                EXPECT_GE(weighted[state.index(i, axis)], isShort ? product[state.index(i, axis)] - 1e-13 : 0.0);
                for (int other = 0; other < 4; ++other)
                    for (int k = 0; k < 3; ++k) {
                        const auto own = static_cast<std::size_t>(other);
                        const double slope = (forceDown[own][k] - forceUp[own][k]) / (2 * h);
                        EXPECT_NEAR(product[state.index(other, k)], slope, 1e-6);
                        if (!isShort)
                            EXPECT_NEAR(weighted[state.index(other, k)], product[state.index(other, k)], 1e-13);
                    }
            }
    }
}

// Σ |w| = 2.8: sums of the rows of k |w| |w|ᵀ.
TEST(PlaceSprings, ShareTheirStiffnessAndDampingRate) {
    const PlanarState<double> state(fourPlaces, fourMasses);
    const StabilityShare share = state.stability(PlaceSprings<double>({threeSprings()[0]}));
    const std::vector<double> weights = {0.8, 0.6, 0.4, 1.0};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(share.stiffness[i], 10.0 * 2.8 * weights[i], 1e-13);
        EXPECT_NEAR(share.dampingRate[i], 3.0 * 2.8 * weights[i] / fourMasses[i], 1e-13);
    }
}

}  // namespace
}  // namespace taut::mechanics
