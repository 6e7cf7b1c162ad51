// The elastica's solver against published numbers and limits, not against itself.
#include <gtest/gtest.h>

#include <cmath>

#include "taut/reality/elastica.h"

namespace taut::reality {
namespace {

constexpr double degree = M_PI / 180;

double droop(double gamma) {
    const HangingStrip strip = hangingStrip(gamma, 0, M_PI / 2);
    return strip.down / strip.out;
}

TEST(Elastica, AStripThatDroopsByPeircesAngleIsTwiceItsBendingLengthLong) {
    const HangingStrip strip = hangingStrip(8, 0, M_PI / 2);
    // Γ = 8; Peirce's 41.5° is a rounding of it.
    EXPECT_NEAR(std::atan2(strip.down, strip.out), 41.4873 * degree, 1e-4 * degree);
}

TEST(Elastica, DroopsAsFiniteDifferencesHaveIt) {
    // θ'' = -Γ (1 - s) cos θ by Newton's method on differences, a code of its own: the digits that are the same.
    EXPECT_NEAR(droop(0.1), 0.0124996, 1e-7);
    EXPECT_NEAR(droop(10), 1.066802, 1e-6);
    EXPECT_NEAR(droop(1000), 21.33544, 1e-4);
    // Small strips droop by Γ/8, long ones hang W = √(2/Γ) + 1.23/Γ beside the clamp.
    EXPECT_NEAR(droop(1e-3) / (1e-3 / 8), 1, 1e-6);
    EXPECT_NEAR(hangingStrip(2000, 0, M_PI / 2).out, std::sqrt(2.0 / 2000) + 1.23 / 2000, 1e-4);
}

TEST(Elastica, BendsUnderALoadAsBisshoppAndDruckerHaveIt) {
    // Table of Mattiasson 1981: w/L and u/L.
    const HangingStrip one = hangingStrip(0, 1, M_PI / 2), ten = hangingStrip(0, 10, M_PI / 2);
    EXPECT_NEAR(one.down, 0.30172, 1e-5);
    EXPECT_NEAR(1 - one.out, 0.05643, 1e-5);
    EXPECT_NEAR(ten.down, 0.81061, 1e-5);
    EXPECT_NEAR(1 - ten.out, 0.55500, 1e-5);
}

TEST(Elastica, AnUprightStripBucklesWhereGreenhillHasIt) {
    EXPECT_NEAR(standingWeight(), 7.83735, 1e-5);  // (9/4) j², j the first zero of J₋⅓
    // It leaves the upright there as the root of the excess.
    const double lean = hangingStrip(7.85, 0, M_PI).out, more = hangingStrip(7.8754, 0, M_PI).out;
    EXPECT_NEAR(more / lean, std::sqrt((7.8754 - 7.83735) / (7.85 - 7.83735)), 0.01);
}

TEST(Elastica, WeightlessLoopsHavePeircesHeights) {
    EXPECT_NEAR(loopOf(LoopKind::ring, 0).height, 1 / M_PI, 1e-6);
    EXPECT_NEAR(loopOf(LoopKind::heart, 0).height, 0.1337, 2e-4);  // Peirce 1930, four digits
    EXPECT_NEAR(loopOf(LoopKind::pear, 0).height, 0.4243, 1e-4);
}

TEST(Elastica, ARodPushedOntoAPlaneBucklesAtItsClassicalLoad) {
    // tan p = p: p² = 20.1907, clamped at one end and hinged at the other.
    EXPECT_NEAR(pushedRod(0.01).thrust, 20.1907, 1e-3);
    // μ = 0.446 √ε at first.
    const PushedRod rod = pushedRodAt(0.02);
    EXPECT_NEAR(rod.friction, 0.02, 1e-9);
    EXPECT_NEAR(rod.friction / std::sqrt(rod.lowering), 0.446, 1e-3);
}

TEST(Elastica, AColumnBucklesAtEulersLoad) {
    EXPECT_NEAR(columnOf(1e-4).thrust, M_PI * M_PI, 1e-7);
    EXPECT_NEAR(columnOf(60 * degree).shortening, 0.25898, 1e-5);  // 2 - 2E/K at k = sin 30°
}

}  // namespace
}  // namespace taut::reality
