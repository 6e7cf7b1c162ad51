// Velocity Verlet: the positions of leap-frog, with velocities at whole steps.
//
//   v½ = v + (h/2)(a_el - γ v),  x' = x + h v½,  v' = (v½ + (h/2) a_el')/(1+b),  b = γ h/2
//
// a_el is kept from the step before. a_el' sees the velocity extrapolated from half steps, w = 1.5 v½ - 0.5 v½(before),
// as in leap-frog. At the start and after a contact a_el is evaluated anew, from v. The state records that there was a
// contact, so a copy of the state goes on in the same way.
#include "taut/ode/method.h"
#include "taut/ode/private/step_limits.h"

namespace taut::ode {
namespace {

template <class Real>
class VelocityVerlet final : public Method<Real> {
  public:
    enum Memory { acceleration, halfVelocity, extrapolated, stale, count };  // stale: one number, 0 or 1

    void start(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        state.memory.assign(count, core::AlignedArray<Real>(state.layout.size()));
        state.memory[stale] = core::AlignedArray<Real>(1);
        system.prescribe(t, state.x.data(), state.v.data());
        evaluate(system, t, state, state.v.data());
        // The half step before the first: v(-h/2) = v0 - (h/2) a(x0, v0).
        forEach(state.layout, [&](std::size_t at, std::size_t i) {
            const Real total = state.memory[acceleration][at] - system.dragRates()[i] * state.v[at];
            state.memory[halfVelocity][at] = state.v[at] - static_cast<Real>(0.5 * h) * total;
        });
        system.prescribe(t - 0.5 * h, nullptr, state.memory[halfVelocity].data());
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        if (state.memory[stale][0] != Real(0)) evaluate(system, t, state, state.v.data());
        state.memory[stale][0] = Real(0);
        const Real half = static_cast<Real>(0.5 * h);
        const Real* drag = system.dragRates();
        forEach(state.layout, [&](std::size_t at, std::size_t i) {
            Real& before = state.memory[halfVelocity][at];
            const Real now = state.v[at] + half * (state.memory[acceleration][at] - drag[i] * state.v[at]);
            state.memory[extrapolated][at] = Real(1.5) * now - Real(0.5) * before;
            before = now;
            state.x[at] += static_cast<Real>(h) * now;
        });
        system.prescribe(t + 0.5 * h, nullptr, state.memory[halfVelocity].data());
        system.prescribe(t + h, state.x.data(), state.memory[extrapolated].data());
        evaluate(system, t + h, state, state.memory[extrapolated].data());
        forEach(state.layout, [&](std::size_t at, std::size_t i) {
            state.v[at] =
                (state.memory[halfVelocity][at] + half * state.memory[acceleration][at]) / (Real(1) + half * drag[i]);
        });
        system.prescribe(t + h, nullptr, state.v.data());
    }

    void synchronise(SecondOrderSystem<Real>&, double, double, const State<Real>& state, Real* v) override {
        for (std::size_t i = 0; i < state.layout.size(); ++i) v[i] = state.v[i];
    }

    void touch(State<Real>& state, std::span<const int> points) override {
        if (!points.empty()) state.memory[stale][0] = Real(1);
        for (int p = 0; p < state.layout.planes; ++p)
            for (int i : points) {
                const auto at = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) * state.layout.stride + i);
                state.memory[halfVelocity][at] = state.v[at];
            }
    }

  private:
    class Store final : public AccelerationSink<Real> {
      public:
        Store(Layout layout, Real* out) : layout_(layout), out_(out) {}
        void take(int first, int last, const Real* const* a) override {
            for (int p = 0; p < layout_.planes; ++p)
                for (int i = first; i < last; ++i)
                    out_[static_cast<std::ptrdiff_t>(p) * layout_.stride + i] = a[p][i - first];
        }

      private:
        Layout layout_;
        Real* out_;
    };

    void evaluate(SecondOrderSystem<Real>& system, double t, State<Real>& state, const Real* v) {
        ++this->work_.evaluations;
        Store store(state.layout, state.memory[acceleration].data());
        system.accelerate(t, state.x.data(), v, store);
    }

    template <class F>
    static void forEach(Layout layout, F&& f) {
        for (int p = 0; p < layout.planes; ++p)
            for (int i = 0; i < layout.count; ++i)
                f(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) * layout.stride + i),
                  static_cast<std::size_t>(i));
    }
};

template <class Real>
std::unique_ptr<Method<Real>> makeVelocityVerlet(const MethodOptions&) {
    return std::make_unique<VelocityVerlet<Real>>();
}

}  // namespace

MethodInfo velocityVerlet() {
    return {.name = "velocity-verlet",
            .title = "velocity Verlet",
            .order = 2,
            .evaluations = 1,
            .storedArrays = 3,
            .symplectic = true,
            .reversible = true,
            .limit = "2 with drag, 2(√(1+4ζ²) - 2ζ) with dashpots",
            .caution = "",
            .largestStep = leapfrogLargestStep,
            .automaticStep = leapfrogLargestStep,
            .make = {makeVelocityVerlet<float>, makeVelocityVerlet<double>}};
}

}  // namespace taut::ode
