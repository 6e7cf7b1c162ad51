// Conjugate gradients against known matrices, and the reports of implicit methods about their solver.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/oscillator.h"
#include "taut/core/error.h"
#include "taut/ode/private/conjugate_gradient.h"

namespace taut::test {
namespace {

// -1, 2.1, -1 along the diagonal: the chain.
template <class Real>
struct Chain {
    std::size_t n;
    Real operator()(const Real* u, std::size_t i) const {
        return Real(2.1) * u[i] - (i > 0 ? u[i - 1] : Real(0)) - (i + 1 < n ? u[i + 1] : Real(0));
    }
    void operator()(const Real* u, Real* out) const {
        for (std::size_t i = 0; i < n; ++i) out[i] = (*this)(u, i);
    }
};

TEST(ConjugateGradient, SolvesAChainWithinItsTolerance) {
    for (double tolerance : {1e-3, 1e-8, 1e-12}) {
        const Chain<double> chain{50};
        std::vector<double> b(50), inverse(50, 1.0 / 2.1), x(50, 0.0);
        for (std::size_t i = 0; i < 50; ++i) b[i] = std::sin(static_cast<double>(i * i));
        ode::ConjugateGradient<double> solver(50);
        const ode::Solution solution = solver.solve(chain, inverse.data(), b.data(), tolerance, 200, x.data());
        EXPECT_TRUE(solution.converged);
        EXPECT_LE(solution.products, 51);  // at most n steps in exact arithmetic, and one for the first residual
        double r2 = 0.0, b2 = 0.0;
        for (std::size_t i = 0; i < 50; ++i) {
            r2 += std::pow(b[i] - chain(x.data(), i), 2);
            b2 += b[i] * b[i];
        }
        EXPECT_LE(std::sqrt(r2 / b2), tolerance * (1.0 + 1e-3));  // the residual is carried along: rounding
        if (tolerance < 1e-3) EXPECT_GT(std::sqrt(r2 / b2), 1e-17);
    }
}

TEST(ConjugateGradient, LeavesGivenUnknownsAndLetsTheOthersSeeThem) {
    const Chain<double> chain{5};
    const std::vector<double> inverse{0.0, 1.0, 1.0, 1.0, 0.0}, b{9.0, 0.0, 0.0, 0.0, 9.0};
    std::vector<double> x{1.0, 0.0, 0.0, 0.0, 3.0};
    ode::ConjugateGradient<double> solver(5);
    EXPECT_TRUE(solver.solve(chain, inverse.data(), b.data(), 1e-14, 20, x.data()).converged);
    EXPECT_EQ(x[0], 1.0);
    EXPECT_EQ(x[4], 3.0);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(chain(x.data(), i), 0.0, 1e-13);  // rounding
}

TEST(ConjugateGradient, NeedsNoStepFromTheSolutionAndNoneForNothing) {
    const Chain<double> chain{8};
    std::vector<double> inverse(8, 0.5), x(8, 1.0), b(8);
    chain(x.data(), b.data());
    ode::ConjugateGradient<double> solver(8);
    EXPECT_EQ(solver.solve(chain, inverse.data(), b.data(), 1e-10, 100, x.data()).products, 1);
    const std::vector<double> nothing(8, 0.0);
    EXPECT_TRUE(solver.solve(chain, inverse.data(), nothing.data(), 1e-10, 100, x.data()).converged);
    for (double value : x) EXPECT_EQ(value, 0.0);
}

TEST(ConjugateGradient, SaysWhenItDidNotConverge) {
    const Chain<float> chain{400};
    std::vector<float> inverse(400, 1.0F / 2.1F), b(400, 0.0F), x(400, 0.0F);
    b[0] = 1.0F;
    ode::ConjugateGradient<float> solver(400);
    const ode::Solution cut = solver.solve(chain, inverse.data(), b.data(), 1e-6, 3, x.data());
    EXPECT_FALSE(cut.converged);
    EXPECT_EQ(cut.products, 4);
    b[7] = NAN;
    EXPECT_FALSE(solver.solve(chain, inverse.data(), b.data(), 1e-6, 500, x.data()).converged);
}

TEST(ImplicitEuler, RefusesASystemWithoutDerivatives) {
    class Bare final : public ode::SecondOrderSystem<double> {
      public:
        ode::Layout layout() const override { return {1, 1, 1}; }
        const double* dragRates() const override { return &none_; }
        void accelerate(double, const double* x, const double*, ode::AccelerationSink<double>& sink) override {
            const double a = -x[0];
            const double* planes[] = {&a};
            sink.take(0, 1, planes);
        }

      private:
        double none_ = 0.0;
    };
    Bare bare;
    const double x = 1.0, v = 0.0;
    const std::span<const double> xs(&x, 1), vs(&v, 1);
    EXPECT_THROW(Integration<double>(bare, "implicit-euler", 0.1, xs, vs), core::Error);
    Integration<double> run(bare, "leapfrog", 0.1, xs, vs);
    run.step(10);
}

// The work of a method equals the calls of the system.
TEST(EveryMethod, CountsItsEvaluations) {
    for (const ode::MethodInfo& info : ode::methods()) {
        SCOPED_TRACE(info.name);
        Oscillator oscillator({2.0, 0.3, 0.1, 0.2, 0.5});
        Integration<double> run = integrate(oscillator, info.name, 0.01, {1.0, 0.0});
        run.step(20);
        run.synchronisedVelocities();
        EXPECT_EQ(run.method().work().evaluations, oscillator.evaluations);
        EXPECT_EQ(run.method().work().unconverged, 0);
        EXPECT_EQ(run.method().work().iterations > 0, std::isinf(info.largestStep({1.0})));
    }
}

}  // namespace
}  // namespace taut::test
