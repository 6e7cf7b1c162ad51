#include "taut/study/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>

namespace taut::study {
namespace {

// One point at a time.
LeastSquares problemOf(const std::function<Vector(const Vector&)>& residuals, Vector start, double low, double high) {
    LeastSquares problem;
    problem.residuals = [residuals](const std::vector<Vector>& points) {
        std::vector<Vector> all;
        for (const Vector& point : points) all.push_back(residuals(point));
        return all;
    };
    problem.low.assign(start.size(), low);
    problem.high.assign(start.size(), high);
    problem.start = std::move(start);
    return problem;
}

// Of rows (1, 0), (1, 1), (1, 2), ten times each, the normal equations are 100 (3 3; 3 5), whose inverse is (5 -3; -3
// 3) / 600.
TEST(LeastSquares, OfALineHasItsTextbookSolutionAndCovariance) {
    const auto line = [](const Vector& x) {
        return Vector{10 * (x[0] - 1.0), 10 * (x[0] + x[1] - 2.5), 10 * (x[0] + 2 * x[1] - 3.0)};
    };
    const Minimum minimum = leastSquares(problemOf(line, {0.0, 0.0}, -10, 10));
    EXPECT_TRUE(minimum.hasConverged);
    // Offset 7/6 and slope 1, to a hundredth of the deviations and the scatter of 50/3: where the sum could fall by
    // less than 1e-4 of itself a value it stops.
    const double scatter = 100.0 / 6;
    EXPECT_NEAR(minimum.x[0], 7.0 / 6, 1e-2 * std::sqrt(scatter * 5 / 600));
    EXPECT_NEAR(minimum.x[1], 1.0, 1e-2 * std::sqrt(scatter * 3 / 600));
    // Made larger by the sum of squares over the one value more than there are unknowns; 1e-4 as that.
    EXPECT_NEAR(minimum.covariance[0][0], scatter * 5 / 600, 1e-4);
    EXPECT_NEAR(minimum.covariance[0][1], -scatter * 3 / 600, 1e-4);
    EXPECT_NEAR(minimum.deviation[1], std::sqrt(scatter * 3 / 600), 1e-4);
    EXPECT_TRUE(minimum.unseen.empty());
}

// A bent valley, whose least value is 0 at (1, 1) (Rosenbrock 1960), each residual over 1e-3.
TEST(LeastSquares, FollowsABentValley) {
    const auto valley = [](const Vector& x) { return Vector{1e4 * (x[1] - x[0] * x[0]), 1e3 * (1 - x[0])}; };
    const Minimum minimum = leastSquares(problemOf(valley, {-1.2, 1.0}, -3, 3));
    EXPECT_TRUE(minimum.hasConverged);
    EXPECT_NEAR(minimum.x[0], 1.0, 1e-5);  // a hundredth of the deviation, 1e-3
    EXPECT_NEAR(minimum.x[1], 1.0, 2e-5);
}

TEST(LeastSquares, ABoundHoldsAnUnknownAndTheOthersGoOn) {
    const auto pulls = [](const Vector& x) { return Vector{100 * (x[0] - 3.0), 100 * (x[1] - x[0])}; };
    const Minimum minimum = leastSquares(problemOf(pulls, {0.5, 0.5}, 0, 2));
    EXPECT_TRUE(minimum.hasConverged);
    EXPECT_EQ(minimum.x[0], 2.0);
    EXPECT_TRUE(minimum.isHeld[0]);
    EXPECT_FALSE(minimum.isHeld[1]);
    EXPECT_TRUE(std::isnan(minimum.deviation[0]));
    EXPECT_NEAR(minimum.x[1], 2.0, 7.1e-3);  // at a sum of 1e4 it stops where that could fall by 0.5
}

TEST(LeastSquares, SaysAlongWhatResidualsHardlyChange) {
    // x + 2y alone is seen: along (2, -1)/√5 nothing changes. z is seen, w changes it by a thousandth of its deviation.
    const auto hidden = [](const Vector& x) {
        const double seen = x[0] + 2 * x[1];
        return Vector{1e3 * (seen - 0.3), 1e3 * std::sin(seen - 0.3), 1e3 * (x[2] - 0.1), 1e-3 * x[3]};
    };
    const Minimum minimum = leastSquares(problemOf(hidden, {0.2, 0.2, 0.2, 0.2}, -1, 1));
    EXPECT_TRUE(minimum.hasConverged);
    EXPECT_NEAR(minimum.x[0] + 2 * minimum.x[1], 0.3, 1e-4);
    ASSERT_EQ(minimum.unseen.size(), 2U);
    for (const Vector& direction : minimum.unseen) {
        const bool isOfW = std::abs(direction[3]) > 0.5;
        EXPECT_NEAR(std::abs(direction[0]), isOfW ? 0.0 : 2 / std::sqrt(5.0), 2e-4);  // of the sine, by differences
        EXPECT_NEAR(direction[0], -2 * direction[1], 2e-4);
        EXPECT_NEAR(std::abs(direction[3]), isOfW ? 1.0 : 0.0, 1e-6);
    }
}

TEST(LeastSquares, GoesRoundPointsWithoutValues) {
    // From 2.0 the whole step is to 0.5, below which there are none.
    const auto root = [](const Vector& x) { return x[0] < 0.6 ? Vector{} : Vector{100 * std::log(x[0])}; };
    const Minimum minimum = leastSquares(problemOf(root, {2.0}, 0, 10));
    EXPECT_TRUE(minimum.hasConverged);
    EXPECT_NEAR(minimum.x[0], 1.0, 1e-3);
    EXPECT_TRUE(leastSquares(problemOf(root, {0.1}, 0, 10)).residuals.empty());
}

// Of (2 1 0; 1 2 1; 0 1 2): 2 and 2 ± √2.
TEST(LeastSquares, EigenvectorsOfAChainAreItsWaves) {
    const std::vector<Vector> chain{{2, 1, 0}, {1, 2, 1}, {0, 1, 2}};
    const Eigenvectors found = eigenvectors(chain);
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(found.values[k], 2 + (k - 1) * std::sqrt(2.0), 1e-14);
        const Vector& v = found.vectors[k];
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(chain[i][0] * v[0] + chain[i][1] * v[1] + chain[i][2] * v[2], found.values[k] * v[i], 1e-14);
    }
}

}  // namespace
}  // namespace taut::study
