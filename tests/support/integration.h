// A method at work on a second-order system: start once, then steps of one length at times from whole numbers.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "taut/ode/method_table.h"

namespace taut::test {

// Implicit methods solve to rounding, so that tests see the method and not its solver.
inline constexpr ode::MethodOptions exactSolves{1, 1e-13, 10000};

template <class Real>
class Integration {
  public:
    // x and v are laid out as the system's layout says.
    Integration(ode::SecondOrderSystem<Real>& system, std::string_view method, double h, std::span<const Real> x,
                std::span<const Real> v, const ode::MethodOptions& options = exactSolves,
                const ode::Methods& methods = ode::builtInMethods())
        : system_(system), method_(methods.make<Real>(method, options)), h_(h), state(system.layout()) {
        for (std::size_t i = 0; i < state.x.size(); ++i) {
            state.x[i] = x[i];
            state.v[i] = v[i];
        }
        method_->start(system_, 0.0, h_, state);
    }

    void step(std::int64_t steps = 1) {
        for (std::int64_t i = 0; i < steps; ++i) method_->step(system_, time(), h_, state), ++n_;
    }

    double time() const { return static_cast<double>(n_) * h_; }
    double h() const { return h_; }
    ode::Method<Real>& method() { return *method_; }

    std::vector<Real> synchronisedVelocities() {
        std::vector<Real> v(state.v.size());
        method_->synchronise(system_, time(), h_, state, v.data());
        return v;
    }

    // Makes the present, with the velocities turned round, the start of a run back in time.
    void reverse() {
        const std::vector<Real> v = synchronisedVelocities();
        for (std::size_t i = 0; i < v.size(); ++i) state.v[i] = -v[i];
        method_->start(system_, time(), h_, state);
    }

  private:
    ode::SecondOrderSystem<Real>& system_;
    std::unique_ptr<ode::Method<Real>> method_;
    double h_;
    std::int64_t n_ = 0;

  public:
    ode::State<Real> state;
};

}  // namespace taut::test
