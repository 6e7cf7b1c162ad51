#include "taut/ode/private/stacked_method.h"

#include <algorithm>

namespace taut::ode {
namespace {

template <class Real>
class Stacked final : public Method<Real> {
  public:
    explicit Stacked(std::unique_ptr<FirstOrderMethod<Real>> method) : method_(std::move(method)) {}

    void start(SecondOrderSystem<Real>& system, double t, double, State<Real>& state) override {
        y_ = core::AlignedArray<Real>(2 * state.layout.size());
        system.prescribe(t, state.x.data(), state.v.data());
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        const std::size_t half = state.layout.size();
        if (y_.size() != 2 * half) y_ = core::AlignedArray<Real>(2 * half);  // another object started this state
        std::copy_n(state.x.data(), half, y_.data());
        std::copy_n(state.v.data(), half, y_.data() + half);
        FirstOrderView<Real> view(system);
        method_->step(view, t, h, y_.data());
        this->work_.evaluations += method_->evaluations();
        std::copy_n(y_.data(), half, state.x.data());
        std::copy_n(y_.data() + half, half, state.v.data());
    }

    void synchronise(SecondOrderSystem<Real>&, double, double, const State<Real>& state, Real* v) override {
        std::copy(state.v.begin(), state.v.end(), v);
    }

    void touch(State<Real>&, std::span<const int>) override {}

  private:
    std::unique_ptr<FirstOrderMethod<Real>> method_;
    core::AlignedArray<Real> y_;  // (2 · size) positions, then velocities
};

}  // namespace

template <class Real>
std::unique_ptr<Method<Real>> makeStacked(std::unique_ptr<FirstOrderMethod<Real>> method) {
    return std::make_unique<Stacked<Real>>(std::move(method));
}
template std::unique_ptr<Method<float>> makeStacked(std::unique_ptr<FirstOrderMethod<float>>);
template std::unique_ptr<Method<double>> makeStacked(std::unique_ptr<FirstOrderMethod<double>>);

}  // namespace taut::ode
