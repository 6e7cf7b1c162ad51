// The damped oscillator, driven and hardened if wanted, and the exact solution of the plain one.
#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "support/integration.h"

namespace taut::test {

// x'' = -ω² x - hardening x³ + drive cos t - c x' - γ x'. A method is given c as a force that depends on the velocity
// (a dashpot) and γ as a drag rate.
class Oscillator final : public ode::SecondOrderSystem<double>, public ode::ImplicitSystem<double> {
  public:
    struct Values {
        double omega = 1.0;      // [1/s]
        double dashpot = 0.0;    // c [1/s]
        double drag = 0.0;       // γ [1/s]
        double hardening = 0.0;  // [1/(m² s²)]
        double drive = 0.0;      // [m/s²]
    };
    explicit Oscillator(const Values& values) : values_(values) {}

    ode::Layout layout() const override { return {1, 1, 1}; }
    const double* dragRates() const override { return &values_.drag; }
    void accelerate(double t, const double* x, const double* v, ode::AccelerationSink<double>& sink) override {
        ++evaluations;
        const double a = -values_.omega * values_.omega * x[0] - values_.hardening * x[0] * x[0] * x[0] +
                         values_.drive * std::cos(t) - values_.dashpot * v[0];
        const double* planes[1] = {&a};
        sink.take(0, 1, planes);
    }
    int evaluations = 0;

    // Of mass 1.
    ode::ImplicitSystem<double>* implicitPart() override { return this; }
    const double* masses() const override { return &one_; }
    const double* inverseMasses() const override { return &one_; }
    void linearise(double, const double* x, const double*, double stiffness, double damping) override {
        slope_ = stiffness * (values_.omega * values_.omega + 3.0 * values_.hardening * x[0] * x[0]) +
                 damping * values_.dashpot;
    }
    void addProduct(const double* u, double* out) const override { out[0] += slope_ * u[0]; }
    void addDiagonal(double* out) const override { out[0] += slope_; }

  private:
    Values values_;
    double one_ = 1.0, slope_ = 0.0;
};

struct Phase {
    double x = 0.0, v = 0.0;
};

inline Integration<double> integrate(Oscillator& oscillator, std::string_view method, double h, Phase start,
                                     const ode::MethodOptions& options = exactSolves,
                                     const ode::Methods& methods = ode::builtInMethods()) {
    const std::span<const double> x(&start.x, 1), v(&start.v, 1);
    return {oscillator, method, h, x, v, options, methods};
}

inline Phase phaseOf(Integration<double>& run) {
    return {run.state.x[0], run.synchronisedVelocities()[0]};
}

// x'' + 2ζω x' + ω² x = 0 with x(0) = d, x'(0) = v0; a = ζω:
//   ζ < 1: e^{-at} [d cos ω_d t + ((v0 + a d)/ω_d) sin ω_d t],   ω_d = √(ω² - a²)
//   ζ = 1: e^{-at} [d + (v0 + a d) t],   ζ > 1: cosh and sinh with √(a² - ω²)
inline Phase exactOscillation(double omega, double zeta, Phase start, double t) {
    const double a = zeta * omega, d = start.x, e = start.v + a * d, decay = std::exp(-a * t);
    double even, odd, oddSlope, evenSlope;  // x = decay (d even + e odd)
    if (zeta < 1.0) {
        const double w = std::sqrt(omega * omega - a * a);
        even = std::cos(w * t), odd = std::sin(w * t) / w, evenSlope = -w * std::sin(w * t), oddSlope = even;
    } else if (zeta == 1.0) {
        even = 1.0, odd = t, evenSlope = 0.0, oddSlope = 1.0;
    } else {
        const double w = std::sqrt(a * a - omega * omega);
        even = std::cosh(w * t), odd = std::sinh(w * t) / w, evenSlope = w * std::sinh(w * t), oddSlope = even;
    }
    const double x = decay * (d * even + e * odd);
    return {x, decay * (d * evenSlope + e * oddSlope) - a * x};
}

}  // namespace taut::test
