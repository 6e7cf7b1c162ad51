// Points moved by hand: written at every time at which forces are asked for, never integrated, in every method.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/integration.h"

namespace taut::test {
namespace {

// Point 0 is led along X(t) = 0.3 sin 2t; point 1 hangs on it by a spring and a dashpot:
//   x'' = -ω² (x - X) - c (x' - X') - γ x'
class Led final : public ode::SecondOrderSystem<double>, public ode::ImplicitSystem<double> {
  public:
    static constexpr double omega2 = 9.0, c = 0.8;
    static double place(double t) { return 0.3 * std::sin(2.0 * t); }
    static double speed(double t) { return 0.6 * std::cos(2.0 * t); }

    ode::Layout layout() const override { return {2, 2, 1}; }
    const double* dragRates() const override { return drag_; }
    void accelerate(double t, const double* x, const double* v, ode::AccelerationSink<double>& sink) override {
        if (isLedAtItsTime)
            EXPECT_NEAR(x[0], place(t), 1e-14);  // the end of a step and the start of the next: a rounding of t
        const double a[] = {0.0, -omega2 * (x[1] - x[0]) - c * (v[1] - v[0])};
        const double* planes[] = {a};
        sink.take(0, 2, planes);
    }
    void prescribe(double t, double* x, double* v) override {
        if (x != nullptr) x[0] = place(t);
        if (v != nullptr) v[0] = speed(t);
    }
    ode::ImplicitSystem<double>* implicitPart() override { return this; }
    const double* masses() const override { return mass_; }
    const double* inverseMasses() const override { return inverseMass_; }
    void linearise(double, const double*, const double*, double stiffness, double damping) override {
        w_ = stiffness * omega2 + damping * c;
    }
    void addProduct(const double* u, double* out) const override {
        out[0] += w_ * (u[0] - u[1]);
        out[1] += w_ * (u[1] - u[0]);
    }
    void addDiagonal(double* out) const override {
        out[0] += w_;
        out[1] += w_;
    }

    // Implicit Euler asks for the forces of the end of the step where the step begins, and adds the rest by products.
    bool isLedAtItsTime = true;

  private:
    double drag_[2] = {0.7, 0.2}, mass_[2] = {1.0, 1.0}, inverseMass_[2] = {0.0, 1.0}, w_ = 0.0;
};

// Classical Runge-Kutta on the one free point, written here.
double reference(double t, int steps) {
    const auto slope = [](double s, double x, double v) {
        return -Led::omega2 * (x - Led::place(s)) - Led::c * (v - Led::speed(s)) - 0.2 * v;
    };
    double x = 1.0, v = 0.0;
    const double h = t / steps;
    for (int i = 0; i < steps; ++i) {
        const double s = t * i / steps, m = s + h / 2;
        const double v2 = v + h / 2 * slope(s, x, v), x2 = x + h / 2 * v;
        const double v3 = v + h / 2 * slope(m, x2, v2), x3 = x + h / 2 * v2;
        const double v4 = v + h * slope(m, x3, v3), x4 = x + h * v3;
        const double a = slope(s, x, v) + 2 * slope(m, x2, v2) + 2 * slope(m, x3, v3) + slope(s + h, x4, v4);
        x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * a;
    }
    return x;
}

TEST(PrescribedPoint, IsWhereItIsLedAndPullsTheRestAtTheOrderOfTheMethod) {
    const double ought = reference(3.0, 6000);  // ω h = 1.5e-3: 1e-14
    for (const ode::MethodInfo& method : ode::methods()) {
        SCOPED_TRACE(method.name);
        double error[2];
        for (int i = 0; i < 2; ++i) {
            Led led;
            led.isLedAtItsTime = method.name != "implicit-euler";
            const int steps = (method.order == 4 ? 75 : 1200) << i;  // order 4: clear of rounding
            const std::vector<double> x{7.0, 1.0}, v{-3.0, 0.0};     // its input is overwritten at once
            Integration<double> run(led, method.name, 3.0 / steps, x, v);
            for (int n = 0; n < steps; ++n) {
                run.step();
                // The time of the step's end, n h + h, may differ from (n + 1) h by a rounding.
                ASSERT_NEAR(run.state.x[0], Led::place(run.time()), 1e-15 * 8);
                ASSERT_NEAR(run.synchronisedVelocities()[0], Led::speed(run.time()), 1e-15 * 16);
            }
            error[i] = run.state.x[1] - ought;
        }
        // h = 2.5e-3 and 0.04: the next term changes the exponent by some hundredths.
        EXPECT_NEAR(std::log2(error[0] / error[1]), method.order, 0.1);
    }
}

}  // namespace
}  // namespace taut::test
