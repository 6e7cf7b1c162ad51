#include "taut/core/trig.h"

#include <gtest/gtest.h>

#include <cmath>

namespace taut::core {
namespace {

// The documented error. The long double functions of the C library are the reference: they carry eleven bits more.
constexpr double bound = 1e-15;

TEST(Trig, AgreesWithLongDoubleOverTheDocumentedRange) {
    for (int i = -20000; i <= 20000; ++i) {
        const double angle = 4.987654321 * i;  // to ±1e5, at no special phase
        EXPECT_NEAR(sine(angle), static_cast<double>(std::sin(static_cast<long double>(angle))), bound) << angle;
        EXPECT_NEAR(cosine(angle), static_cast<double>(std::cos(static_cast<long double>(angle))), bound) << angle;
    }
}

TEST(Trig, IsExactAtZero) {
    EXPECT_EQ(sine(0.0), 0.0);
    EXPECT_EQ(cosine(0.0), 1.0);
}

TEST(Trig, SquaresAddToOneNearTheSeamsOfTheQuadrants) {
    for (int quadrant = -8; quadrant <= 8; ++quadrant)
        for (double offset : {-0.25 * pi, -1e-9, 0.0, 1e-9, 0.25 * pi}) {
            const double angle = 0.5 * pi * quadrant + offset, s = sine(angle), c = cosine(angle);
            EXPECT_NEAR(s * s + c * c, 1.0, 4e-16);  // two roundings of a number near one
        }
}

}  // namespace
}  // namespace taut::core
