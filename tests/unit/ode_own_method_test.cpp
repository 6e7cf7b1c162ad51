// A method from outside the engine: Ralston's of second order, whose stages lie where they make the error smallest.
//
//   y' = y + h (k₁/4 + 3 k₂/4),  k₁ = f(t, y),  k₂ = f(t + 2h/3, y + (2h/3) k₁)
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/oscillator_measures.h"
#include "taut/core/error.h"

namespace taut::test::own_method {
namespace {

template <class Real>
class Ralston final : public ode::FirstOrderMethod<Real> {
  public:
    void step(ode::System<Real>& system, double t, double h, Real* y) override {
        const std::size_t n = system.size();
        std::vector<Real> first(n), second(n), stage(n);
        system.derivative(t, y, first.data());
        for (std::size_t i = 0; i < n; ++i) stage[i] = y[i] + static_cast<Real>(2.0 / 3.0 * h) * first[i];
        system.prescribe(t + 2.0 / 3.0 * h, stage.data());
        system.derivative(t + 2.0 / 3.0 * h, stage.data(), second.data());
        for (std::size_t i = 0; i < n; ++i) y[i] += static_cast<Real>(h / 4.0) * (first[i] + Real(3) * second[i]);
        system.prescribe(t + h, y);
    }
    int evaluations() const override { return 2; }
};

template <class Real>
std::unique_ptr<ode::FirstOrderMethod<Real>> makeRalston() {
    return std::make_unique<Ralston<Real>>();
}

ode::Methods withRalston() {
    const ode::MethodInfo& heun = *ode::findMethod("heun");  // on linear problems the same polynomial
    ode::Methods methods = ode::builtInMethods();
    methods.add({.name = "ralston",
                 .title = "Ralston",
                 .order = 2,
                 .evaluations = 2,
                 .storedArrays = 8,
                 .symplectic = false,
                 .reversible = false,
                 .limit = "as Heun",
                 .caution = heun.caution,
                 .largestStep = heun.largestStep,
                 .automaticStep = heun.automaticStep,
                 .make = {makeRalston<float>, makeRalston<double>}});
    return methods;
}

TEST(OwnMethod, StandsLastInItsOwnTableAndNotInTheEngines) {
    const ode::Methods methods = withRalston();
    EXPECT_EQ(methods.all().size(), ode::methods().size() + 1);
    EXPECT_EQ(methods.all().back().name, "ralston");
    EXPECT_EQ(methods.find("ralston"), &methods.all().back());
    EXPECT_EQ(ode::findMethod("ralston"), nullptr);
    EXPECT_EQ(methods.make<float>("ralston")->work().evaluations, 0);
    try {
        methods.makeFirstOrder<double>("leapfrog");
        FAIL() << "leap-frog was made for y' = f(t, y)";
    } catch (const core::Error& error) {
        EXPECT_NE(std::string(error.what()).find("rk4, ralston"), std::string::npos) << error.what();
    }
}

// ω h = 0.0125: the next term of the error changes the exponent by 0.02 at most; 0.05 is the tolerance on either side.
TEST(OwnMethod, HasOrderTwoOnTheOscillator) {
    const ode::Methods methods = withRalston();
    for (double zeta : {0.0, 0.1, 0.5}) {
        const MeasuredOrder order = measuredOrder("ralston", {2.0, zeta, 0.4}, 80, methods);
        EXPECT_NEAR(order.x, 2.0, 0.05) << "ζ = " << zeta;
        EXPECT_NEAR(order.v, 2.0, 0.05) << "ζ = " << zeta;
    }
}

// 1 + w + w²/2 has the modulus 1 where z³/4 - ζz² + 2ζ²z - 2ζ = 0; at ζ = 1/2 that is (z - 2)(z² + 2) = 0.
TEST(OwnMethod, StandsStepsUpToTheEdgeOfItsStabilityRegion) {
    const ode::Methods methods = withRalston();
    const Damping damping{5.0, 0.5, 0.4};
    expectLimit("ralston", damping.values(), 2.0 / 5.0, methods);
    EXPECT_NEAR(methods.find("ralston")->largestStep({.omega = 5.0, .tau = 0.2}), 2.0 / 5.0, 1e-12);  // rounding
}

}  // namespace
}  // namespace taut::test::own_method
