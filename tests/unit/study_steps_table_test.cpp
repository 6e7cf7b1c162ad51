// The slides' tables: y' = y against the formulas of each method's own growth a step, y' + y/x = -4 against theirs.
#include "taut/study/steps_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "taut/study/problems.h"

namespace taut::study {
namespace {

// The factor of one step of length h, less one: the Taylor sum of e^h up to the method's order.
long double growth(int order, long double h) {
    long double term = 1, sum = 0;
    for (int k = 1; k <= order; ++k) sum += term *= h / static_cast<long double>(k);
    return sum;
}

const std::map<std::string, int> orders = {{"euler", 1}, {"heun", 2}, {"midpoint", 2}, {"rk4", 4}};

long double exactError(int order, long long n) {
    const auto steps = static_cast<long double>(n);
    return std::abs(std::numbers::e_v<long double> - std::exp(steps * std::log1p(growth(order, 1 / steps))));
}

long long exactSteps(int order, long double tolerance) {
    long long tooFew = 0, enough = 1;
    while (exactError(order, enough) >= tolerance) tooFew = enough, enough *= 2;
    while (enough - tooFew > 1) {
        const long long middle = (tooFew + enough) / 2;
        (exactError(order, middle) < tolerance ? enough : tooFew) = middle;
    }
    return enough;
}

// 1e-5 instead of the slides' 1e-6 keeps Euler short; a step more or less changes its error by 7e-11, while rounding
// adds up to about 1e-13, so that the count is exact.
TEST(StepsTable, StepsForAToleranceAreThoseOfTheFormulas) {
    const std::vector<StepsRow> rows = stepsTable(*makeProblem("growth"), 1e-5);
    ASSERT_EQ(rows.size(), orders.size());
    for (const StepsRow& row : rows) {
        ASSERT_TRUE(orders.contains(row.method)) << row.method;
        EXPECT_EQ(row.steps, exactSteps(orders.at(row.method), 1e-5L)) << row.method;
        EXPECT_LT(row.error, 1e-5);
        EXPECT_EQ(row.evaluations, row.steps * orders.at(row.method)) << row.method;
    }
}

TEST(StepsTable, HasRowsForTheMethodsAskedForAlone) {
    const std::vector<StepsRow> rows =
        stepsTable(*makeProblem("growth"), 1e-2, {"rk4", "leapfrog"});  // leap-frog does not integrate y' = y
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].method, "rk4");
}

TEST(StepsTable, TheSlidesOwnToleranceForHigherOrders) {
    EXPECT_GE(endError(*makeProblem("growth"), "rk4", exactSteps(4, 1e-6L) - 1), 1e-6);
    EXPECT_LT(endError(*makeProblem("growth"), "rk4", exactSteps(4, 1e-6L)), 1e-6);
    EXPECT_GE(endError(*makeProblem("growth"), "midpoint", exactSteps(2, 1e-6L) - 1), 1e-6);
    EXPECT_LT(endError(*makeProblem("growth"), "midpoint", exactSteps(2, 1e-6L)), 1e-6);
}

// One step of RK4 against two of the second order and four of Euler: 65/24, (13/8)² and (5/4)⁴ instead of e.
TEST(StepsTable, FourEvaluationsBuyWhatTheFormulasSay) {
    const std::map<std::string, double> results = {
        {"euler", 625.0 / 256.0}, {"heun", 169.0 / 64.0}, {"midpoint", 169.0 / 64.0}, {"rk4", 65.0 / 24.0}};
    for (const StepsRow& row : stepsTable(*makeProblem("growth"), 1e-2)) {
        EXPECT_EQ(row.stepsForFour * orders.at(row.method), 4) << row.method;
        // A few roundings of numbers below 3.
        EXPECT_NEAR(row.errorForFour, std::numbers::e - results.at(row.method), 4e-15) << row.method;
    }
}

// Euler's y_n = 3 (1 - h)/(x_n - h) - 2 x_n errs by 3/4 / (n - 1/2) at x = 2: less than 1e-5 from 75001 steps on, less
// than the slides' 1e-6 from 750001. Heun and RK4 integrate this equation exactly; 531 of the midpoint is the slides'.
TEST(StepsTable, OfTheQuotientAreThoseOfTheSlides) {
    const std::unique_ptr<Subject> quotient = makeProblem("quotient");
    for (const StepsRow& row : stepsTable(*quotient, 1e-5)) {
        if (row.method == "euler") {
            EXPECT_EQ(row.steps, 75001);
        } else if (row.method != "midpoint") {
            EXPECT_EQ(row.steps, 1) << row.method;
            EXPECT_LT(row.error, 1e-14) << row.method;  // a few roundings of numbers below 4
        }
    }
    EXPECT_EQ(stepsTable(*quotient, 1e-6, {"midpoint"}).at(0).steps, 531);
}

}  // namespace
}  // namespace taut::study
