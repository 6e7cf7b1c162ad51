// The damped oscillator x'' = -ω² x - c x' - γ x' with ω = 1, as methods see a spring with a dashpot and a drag.
#pragma once

#include "taut/ode/system.h"

namespace taut::study {

enum class Damping { none, drag, dashpot };

// Damping ratio ζ: the rate 2ζ is given as a drag, which methods may treat implicitly, or as a force that depends on
// the velocity. Of mass 1.
class Oscillator final : public ode::SecondOrderSystem<double>, public ode::ImplicitSystem<double> {
  public:
    Oscillator(double zeta, Damping damping)
        : dashpot_(damping == Damping::dashpot ? 2 * zeta : 0.0), drag_(damping == Damping::drag ? 2 * zeta : 0.0) {}

    ode::Layout layout() const override { return {1, 1, 1}; }
    const double* dragRates() const override { return &drag_; }
    void accelerate(double, const double* x, const double* v, ode::AccelerationSink<double>& sink) override {
        const double a = -x[0] - dashpot_ * v[0];
        const double* planes[1] = {&a};
        sink.take(0, 1, planes);
    }

    ode::ImplicitSystem<double>* implicitPart() override { return this; }
    const double* masses() const override { return &mass_; }
    const double* inverseMasses() const override { return &mass_; }
    void linearise(double, const double*, const double*, double stiffness, double damping) override {
        slope_ = stiffness + damping * dashpot_;
    }
    void addProduct(const double* u, double* out) const override { out[0] += slope_ * u[0]; }
    void addDiagonal(double* out) const override { out[0] += slope_; }

  private:
    double dashpot_, drag_;  // [1/s]
    double mass_ = 1.0, slope_ = 0.0;
};

}  // namespace taut::study
