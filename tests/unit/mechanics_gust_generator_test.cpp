#include <gtest/gtest.h>

#include <cmath>

#include "taut/mechanics/private/noise.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;

const GustField field{2.5, 1.7, 2.0, 7};

TEST(Gust, IsAPureFunctionOfTimePlaceAndSeed) {
    const dvec3 x(0.3, 1.1, -0.4);
    const dvec3 first = gustVelocity(field, 12.25, x);
    gustVelocity(field, 3.0, {5, 5, 5});
    EXPECT_EQ(gustVelocity(field, 12.25, x), first);
    GustField other = field;
    other.seed = 8;
    EXPECT_GT(glm::length(gustVelocity(other, 12.25, x) - first), 0.01);
}

TEST(Gust, WithoutAmplitudeIsStill) {
    GustField still = field;
    still.amplitude = 0.0;
    EXPECT_EQ(gustVelocity(still, 1.0, {1, 2, 3}), dvec3(0.0));
}

// Over 400 periods and many places: a mean of n independent samples of size σ is within 4 σ/√n; time gives about
// two hundred independent ones, and six seeds.
TEST(Gust, StaysBelowItsAmplitudeAndAveragesToZero) {
    dvec3 sum(0.0);
    double squares = 0.0, largest = 0.0;
    int count = 0;
    for (std::int64_t seed = 1; seed <= 6; ++seed) {
        GustField f = field;
        f.seed = seed;
        for (int i = 0; i < 4000; ++i) {
            const dvec3 g = gustVelocity(f, 0.17 * i, {0.7 * (i % 11), 0.9 * (i % 7), 1.1 * (i % 5)});
            sum += g;
            squares += glm::dot(g, g);
            largest = std::max(largest, glm::length(g));
            ++count;
        }
    }
    const double rms = std::sqrt(squares / count);
    EXPECT_LE(largest, 2.5);
    EXPECT_GT(largest, 2.0);
    EXPECT_GT(rms, 0.35 * 2.5);  // strong enough to be seen: about half of the amplitude
    EXPECT_LT(rms, 0.80 * 2.5);
    EXPECT_LT(glm::length(sum / static_cast<double>(count)), 4.0 * rms / std::sqrt(6.0 * 200.0));
}

// Speeds change by less than 2π · amplitude a quarter of a period, or of a length; and the slope is continuous:
// over a step h it changes by O(h), where a kink would leave a change that does not shrink.
TEST(Gust, IsSmoothInTimeAndPlace) {
    const dvec3 direction = glm::normalize(dvec3(1.0, 0.4, -0.7));
    auto alongTime = [&](double s) { return gustVelocity(field, s, {0.2, 1.0, 0.1}); };
    auto alongPlace = [&](double s) { return gustVelocity(field, 4.0, s * direction); };
    auto worstKink = [](auto&& f, double h) {
        double worst = 0.0;
        for (double s = 0.0; s < 12.0; s += 0.5 * h)
            worst = std::max(worst, glm::length(f(s + h) - 2.0 * f(s) + f(s - h)) / h);
        return worst;
    };
    EXPECT_LT(worstKink(alongTime, 1e-3), 0.2 * worstKink(alongTime, 1e-2));  // ten times finer, a tenth but for noise
    EXPECT_LT(worstKink(alongPlace, 1e-3), 0.2 * worstKink(alongPlace, 1e-2));
    for (double s = 0.0; s < 12.0; s += 0.01) {
        EXPECT_LT(glm::length(alongTime(s + 0.01) - alongTime(s)), 0.01 * 8.0 * 2.5 * 2.0 * 3.15 / 1.7);
        EXPECT_LT(glm::length(alongPlace(s + 0.01) - alongPlace(s)), 0.01 * 8.0 * 2.5 * 2.0 * 3.15 / 2.0);
    }
}

TEST(Gust, DiffersBetweenPlacesALengthApart) {
    double apart = 0.0, near = 0.0;
    for (int i = 0; i < 50; ++i) {
        const dvec3 x(0.37 * i, 0.0, 0.21 * i);
        apart += glm::length(gustVelocity(field, 0.5 * i, x) - gustVelocity(field, 0.5 * i, x + dvec3(2, 0, 0)));
        near += glm::length(gustVelocity(field, 0.5 * i, x) - gustVelocity(field, 0.5 * i, x + dvec3(0.02, 0, 0)));
    }
    EXPECT_GT(apart, 10.0 * near);
}

TEST(Gust, DoesNotRepeatItself) {
    // After a whole number of periods the waves have moved on and their strengths are other ones.
    double difference = 0.0;
    for (int k = 1; k <= 20; ++k)
        difference +=
            glm::length(gustVelocity(field, 1.0 + k * field.period, dvec3(0.0)) - gustVelocity(field, 1.0, dvec3(0.0)));
    EXPECT_GT(difference / 20.0, 0.2 * field.amplitude);
}

TEST(Gust, HoldsFarFromTheOriginAndLate) {
    EXPECT_LE(glm::length(gustVelocity(field, 1e7, {1e6, -1e6, 1e6})), 2.5);
    EXPECT_TRUE(std::isfinite(gustVelocity(field, 1e7, {1e30, 0, 0}).x));
    EXPECT_LE(glm::length(gustVelocity(field, -3.0, {-5, -5, -5})), 2.5);
}

}  // namespace
}  // namespace taut::mechanics
