// Methods for y' = f(t, y): the equations of the slides, order from both sides, and a clear word where a method needs
// x'' = a.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/oscillator.h"
#include "taut/core/error.h"

namespace taut::test {
namespace {

constexpr const char* firstOrderMethods[] = {"euler", "heun", "midpoint", "rk4"};
constexpr const char* secondOrderMethods[] = {"symplectic-euler", "velocity-verlet", "leapfrog",
                                              "blanes-moan",      "implicit-euler",  "sdirk2"};

// y' = y, exact: e^t.
class Growth final : public ode::System<double> {
  public:
    std::size_t size() const override { return 1; }
    void derivative(double, const double* y, double* dydt) override {
        ++evaluations;
        dydt[0] = y[0];
    }
    int evaluations = 0;
};

// y' + y/x = -4, y(1) = 1, exact: y = 3/x - 2x.
class Quotient final : public ode::System<double> {
  public:
    std::size_t size() const override { return 1; }
    void derivative(double x, const double* y, double* dydt) override { dydt[0] = -4.0 - y[0] / x; }
};

// y' = cos t - y²: neither linear nor without t.
class Forced final : public ode::System<double> {
  public:
    std::size_t size() const override { return 1; }
    void derivative(double t, const double* y, double* dydt) override { dydt[0] = std::cos(t) - y[0] * y[0]; }
};

double integrated(ode::System<double>& system, const char* name, double from, double to, int steps, double y) {
    const auto method = ode::makeFirstOrderMethod<double>(name);
    const double h = (to - from) / steps;
    for (int i = 0; i < steps; ++i) method->step(system, from + i * h, h, &y);
    return y;
}

TEST(FirstOrderMethod, GrowsByItsOwnPolynomialEachStep) {
    // 1 + h, 1 + h + h²/2, … + h⁴/24: e^h to each order. Rounding of ten steps.
    constexpr double h = 0.1;
    const double factors[] = {1 + h, 1 + h + h * h / 2, 1 + h + h * h / 2,
                              1 + h + h * h / 2 + h * h * h / 6 + h * h * h * h / 24};
    for (int i = 0; i < 4; ++i) {
        Growth growth;
        EXPECT_NEAR(integrated(growth, firstOrderMethods[i], 0.0, 1.0, 10, 1.0), std::pow(factors[i], 10), 1e-14)
            << firstOrderMethods[i];
        EXPECT_EQ(growth.evaluations, 10 * ode::findMethod(firstOrderMethods[i])->evaluations);
    }
}

TEST(FirstOrderMethod, HasItsOrderFromBothSides) {
    Forced forced;
    const double ought = integrated(forced, "rk4", 0.0, 2.0, 20000, 0.5);  // its error is 1e-17 h⁴-wise: rounding
    for (const char* name : firstOrderMethods) {
        const int steps = ode::findMethod(name)->order == 4 ? 80 : 640;  // order 4: clear of rounding
        const double coarse = integrated(forced, name, 0.0, 2.0, steps, 0.5) - ought;
        const double fine = integrated(forced, name, 0.0, 2.0, 2 * steps, 0.5) - ought;
        // h = 1/40 and 1/320: the next term changes the exponent by some hundredths.
        EXPECT_NEAR(std::log2(coarse / fine), ode::findMethod(name)->order, 0.1) << name;
    }
}

// Heun integrates y' + y/x = -4 exactly: a fact of this equation, so it is no test of the order.
TEST(FirstOrderMethod, FollowsTheHyperbolaOfTheSlides) {
    Quotient quotient;
    const double ought = 3.0 / 2.0 - 4.0;
    for (const char* name : {"heun", "rk4"})
        EXPECT_NEAR(integrated(quotient, name, 1.0, 2.0, 10, 1.0), ought, 1e-13) << name;  // rounding
    const double coarse = integrated(quotient, "euler", 1.0, 2.0, 200, 1.0) - ought;
    const double fine = integrated(quotient, "euler", 1.0, 2.0, 400, 1.0) - ought;
    EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.1);
}

std::string messageOf(const char* name) {
    try {
        ode::makeFirstOrderMethod<double>(name);
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::usage);
        return error.what();
    }
    ADD_FAILURE() << name << " was made";
    return "";
}

TEST(FirstOrderMethod, IsRefusedWhereAMethodNeedsPositionsAndVelocitiesApart) {
    for (const char* name : secondOrderMethods) {
        EXPECT_FALSE(ode::findMethod(name)->isFirstOrder());
        const std::string message = messageOf(name);
        EXPECT_NE(message.find(ode::findMethod(name)->title), std::string::npos) << message;
        EXPECT_NE(message.find("x'' = a"), std::string::npos) << message;
        for (const char* other : firstOrderMethods) EXPECT_NE(message.find(other), std::string::npos) << message;
    }
    EXPECT_NE(messageOf("leap").find("no method \"leap\""), std::string::npos);
    for (const char* name : firstOrderMethods) EXPECT_TRUE(ode::findMethod(name)->isFirstOrder());
}

// The adapter adds nothing of its own: the same bits as the method on the first-order view.
TEST(FirstOrderMethod, GivesTheSameBitsOnASecondOrderSystem) {
    for (const char* name : firstOrderMethods) {
        Oscillator oscillator({3.0, 0.4, 0.5, 0.2, 0.6});
        Integration<double> run = integrate(oscillator, name, 0.01, {1.0, 0.3});
        ode::FirstOrderView<double> view(oscillator);
        const auto method = ode::makeFirstOrderMethod<double>(name);
        double y[2] = {1.0, 0.3};
        for (int i = 0; i < 100; ++i) {
            run.step();
            method->step(view, i * 0.01, 0.01, y);
            ASSERT_EQ(run.state.x[0], y[0]) << name;
            ASSERT_EQ(run.state.v[0], y[1]) << name;
        }
    }
}

}  // namespace
}  // namespace taut::test
