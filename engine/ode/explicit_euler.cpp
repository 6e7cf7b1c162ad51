// Explicit Euler: y' = y + h f(t, y), from old data only. Order 1; without damping unstable for every step:
// kept as a comparison.
#include <cmath>

#include "ode/method_table.h"

namespace taut::ode {
namespace {

template <class Real>
class ExplicitEuler final : public Method<Real> {
  public:
    void start(SecondOrderSystem<Real>&, double, double, State<Real>& state) override { prepare(state.layout); }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        const std::size_t half = state.layout.size();
        if (y_.size() != 2 * half) prepare(state.layout);  // a state that another one started
        for (std::size_t i = 0; i < half; ++i) {
            y_[i] = state.x[i];
            y_[half + i] = state.v[i];
        }
        FirstOrderView<Real>(system).derivative(t, y_.data(), derivative_.data());
        for (std::size_t i = 0; i < half; ++i) {
            state.x[i] += static_cast<Real>(h) * derivative_[i];
            state.v[i] += static_cast<Real>(h) * derivative_[half + i];
        }
    }

    void synchronise(SecondOrderSystem<Real>&, double, double, const State<Real>& state, Real* v) override {
        for (std::size_t i = 0; i < state.layout.size(); ++i) v[i] = state.v[i];
    }

    void touch(State<Real>&, std::span<const int>) override {}

  private:
    void prepare(Layout layout) {
        y_ = core::AlignedArray<Real>(2 * layout.size());
        derivative_ = y_;
    }

    core::AlignedArray<Real> y_, derivative_;
};

}  // namespace

template <class Real>
std::unique_ptr<Method<Real>> makeExplicitEuler() {
    return std::make_unique<ExplicitEuler<Real>>();
}
template std::unique_ptr<Method<float>> makeExplicitEuler();
template std::unique_ptr<Method<double>> makeExplicitEuler();

// A mode of rate ω with damping ratio ζ stands h <= 2ζ/ω for ζ < 1 and 2(ζ - √(ζ²-1))/ω above (numerics: section 2). With
// dashpots and drag, ζ = (τ ω + γ/ω)/2, both are smallest for the fastest mode: for ζ < 1 the first is τ + γ/ω², and an
// overdamped mode decays at most at the rate ω (ζ + √(ζ²-1)). Wind and anchors damp some modes and not others: each mode
// stands the smaller of the limits with and without them. Springs under tension add motion that no dashpot damps; then the
// limit is too high.
double explicitEulerLargestStep(const FastestMode& mode) {
    if (mode.omega <= 0.0) {
        const double rate = mode.rate + mode.drag;
        return rate > 0.0 ? 2.0 / rate : HUGE_VAL;
    }
    const auto limit = [&](double rate) {
        const double zeta = 0.5 * (mode.tau * mode.omega + rate / mode.omega);
        if (zeta < 1.0) return 2.0 * zeta / mode.omega;
        return 2.0 / (mode.omega * (zeta + std::sqrt(zeta * zeta - 1.0)));
    };
    return std::fmin(limit(mode.drag), limit(mode.drag + mode.rate));
}

}  // namespace taut::ode
