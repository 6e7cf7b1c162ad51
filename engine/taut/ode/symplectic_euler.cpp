// Symplectic Euler: leap-frog without the half step at the start. Order 1, symplectic.
//
//   v' = (v + h a_el(t, x, v))/(1 + h γ),  x' = x + h v'
//
// Drag is implicit, other velocity forces see v.
#include <cmath>

#include "taut/ode/method.h"

namespace taut::ode {
namespace {

template <class Real>
class SymplecticEuler final : public Method<Real> {
  public:
    void start(SecondOrderSystem<Real>& system, double t, double, State<Real>& state) override {
        system.prescribe(t, state.x.data(), state.v.data());
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        Update update(static_cast<Real>(h), system.dragRates(), state);
        system.accelerate(t, state.x.data(), state.v.data(), update);
        system.prescribe(t + h, state.x.data(), state.v.data());
        ++this->work_.evaluations;
    }

    void synchronise(SecondOrderSystem<Real>&, double, double, const State<Real>& state, Real* v) override {
        for (std::size_t i = 0; i < state.layout.size(); ++i) v[i] = state.v[i];
    }

    void touch(State<Real>&, std::span<const int>) override {}

  private:
    class Update final : public AccelerationSink<Real> {
      public:
        Update(Real h, const Real* drag, State<Real>& state) : h_(h), drag_(drag), state_(state) {}
        void take(int first, int last, const Real* const* a) override {
            for (int p = 0; p < state_.layout.planes; ++p) {
                const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(p) * state_.layout.stride;
                Real *x = state_.x.data() + plane, *v = state_.v.data() + plane;
                for (int i = first; i < last; ++i) {
                    v[i] = (v[i] + h_ * a[p][i - first]) / (Real(1) + h_ * drag_[i]);
                    x[i] += h_ * v[i];
                }
            }
        }

      private:
        Real h_;
        const Real* drag_;
        State<Real>& state_;
    };
};

template <class Real>
std::unique_ptr<Method<Real>> makeSymplecticEuler(const MethodOptions&) {
    return std::make_unique<SymplecticEuler<Real>>();
}

// Largest h with h²ω² + 2h(τω² + c - γ) < 4, from the trace and determinant of a step of the damped oscillator. Drag
// raises the limit, so the smallest drag of a point counts.
double symplecticEulerLargestStep(const FastestMode& mode) {
    if (mode.omega <= 0.0) return mode.rate > mode.drag ? 2.0 / (mode.rate - mode.drag) : HUGE_VAL;
    const double omega2 = mode.omega * mode.omega;
    const double b = 0.5 * (mode.tau * omega2 + mode.rate - mode.drag);  // h²ω²/4 + h b - 1 = 0
    const double root = std::sqrt(b * b + omega2);
    // Each form avoids a difference of nearly equal numbers.
    return b >= 0.0 ? 2.0 / (root + b) : 2.0 * (root - b) / omega2;
}

}  // namespace

MethodInfo symplecticEuler() {
    return {.name = "symplectic-euler",
            .title = "symplectic Euler",
            .order = 1,
            .evaluations = 1,
            .storedArrays = 0,
            .symplectic = true,
            .reversible = false,
            .limit = "2(√(1+ζ²) - ζ) with dashpots, 2(√(1+ζ²) + ζ) with drag",
            .caution = "",
            .largestStep = symplecticEulerLargestStep,
            .automaticStep = symplecticEulerLargestStep,
            .make = {makeSymplecticEuler<float>, makeSymplecticEuler<double>}};
}

}  // namespace taut::ode
