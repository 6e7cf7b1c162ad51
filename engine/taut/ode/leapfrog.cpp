// Leap-frog, force evaluation first: one evaluation a step, order 2, symplectic.
//
//   v⁺ = [(1-b) v⁻ + h a_el(t, x, w)]/(1+b),  b = γ h/2        velocities live at half steps
//   x' = x + h v⁺
//   w' = 1.5 v⁺ - 0.5 v⁻                                        velocity at t + h for dashpots and wind
//
// Drag is semi-implicit (limit h ω < 2 for any γ). Other velocity forces see the extrapolated w. This keeps order 2, at
// the limit h²ω² + 4hc < 4 for a modal rate c. Start: v(-h/2) = v0 - (h/2) a(x0, v0), w = v0.
#include <algorithm>
#include <atomic>

#include "taut/core/private/instruction_set.h"
#include "taut/ode/method.h"
#include "taut/ode/private/leapfrog_parts.h"
#include "taut/ode/private/step_limits.h"
#include "taut/ode/private/update_kernel.h"

namespace taut::ode {

TAUT_KERNELS(template <class Real> bool leapfrog(int n, const Real* a, const Real* keep, const Real* gain, Real h,
                                                 Real limit, Real* x, Real* v, Real* w);)

template <class Real>
LeapfrogUpdate<Real> leapfrogUpdate() {
    return TAUT_IN_USE(leapfrog<Real>);
}
template LeapfrogUpdate<float> leapfrogUpdate();
template LeapfrogUpdate<double> leapfrogUpdate();

namespace {

template <class Real>
class Leapfrog final : public Method<Real> {
  public:
    void start(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        prepare(system, h, state.layout);
        system.prescribe(t, state.x.data(), state.v.data());
        state.memory.assign(1, state.v);
        HalfStepBack back(*this, static_cast<Real>(h), system.dragRates(), state);
        system.accelerate(t, state.x.data(), state.memory[0].data(), back);
        system.prescribe(t - 0.5 * h, nullptr, state.v.data());
        ++this->work_.evaluations;
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        if (h != h_) prepare(system, h, state.layout);
        Update update(*this, static_cast<Real>(h), state);
        system.accelerate(t, state.x.data(), state.memory[0].data(), update);
        this->speeds_ = update.isBeyond ? Speeds::beyond : Speeds::within;
        system.prescribe(t + h, state.x.data(), state.memory[0].data());
        system.prescribe(t + 0.5 * h, nullptr, state.v.data());
        ++this->work_.evaluations;
    }

    // v_n = ½(v⁻ + v⁺), with the v⁺ that the next step will compute.
    void synchronise(SecondOrderSystem<Real>& system, double t, double h, const State<Real>& state, Real* v) override {
        if (h != h_) prepare(system, h, state.layout);
        Centre centre(*this, state, v);
        system.accelerate(t, state.x.data(), state.memory[0].data(), centre);
        system.prescribe(t, nullptr, v);
        ++this->work_.evaluations;
    }

    void touch(State<Real>& state, std::span<const int> points) override { takeAsPredicted(state, points); }
    const Real* predicted(const State<Real>& state) const override { return state.memory[0].data(); }

  private:
    void prepare(SecondOrderSystem<Real>& system, double h, Layout layout) {
        h_ = h;
        update_ = leapfrogUpdate<Real>();
        const auto stride = static_cast<std::size_t>(layout.stride);
        keep_ = core::AlignedArray<Real>(stride);
        gain_ = core::AlignedArray<Real>(stride);
        const Real* drag = system.dragRates();
        for (std::size_t i = 0; i < stride; ++i) {
            const double b = 0.5 * h * static_cast<double>(drag[i]);
            keep_[i] = static_cast<Real>((1.0 - b) / (1.0 + b));
            gain_[i] = static_cast<Real>(h / (1.0 + b));
        }
        isDragUniform_ = std::all_of(drag, drag + layout.count, [&](Real d) { return d == drag[0]; });
    }

    struct Sink : AccelerationSink<Real> {
        explicit Sink(const Leapfrog& m, Layout l) : method(m), layout(l) {}
        std::ptrdiff_t plane(int p) const { return static_cast<std::ptrdiff_t>(p) * layout.stride; }
        const Leapfrog& method;
        Layout layout;
    };

    struct Update final : Sink {
        Update(const Leapfrog& m, Real step, State<Real>& s) : Sink(m, s.layout), h(step), state(s) {}
        void take(int first, int last, const Real* const* a) override {
            // If all points have the same drag, every range uses the start of the tables, which stays in the cache.
            const int entry = this->method.isDragUniform_ ? 0 : first;
            for (int p = 0; p < this->layout.planes; ++p) {
                const std::ptrdiff_t at = this->plane(p) + first;
                const bool isWithin = this->method.update_(
                    last - first, a[p], this->method.keep_.data() + entry, this->method.gain_.data() + entry, h,
                    this->method.speedLimit_, state.x.data() + at, state.v.data() + at, state.memory[0].data() + at);
                if (!isWithin) isBeyond.store(true, std::memory_order_relaxed);
            }
        }
        Real h;
        State<Real>& state;
        std::atomic<bool> isBeyond = false;
    };

    struct HalfStepBack final : Sink {
        HalfStepBack(const Leapfrog& m, Real step, const Real* d, State<Real>& s)
            : Sink(m, s.layout), h(step), drag(d), state(s) {}
        void take(int first, int last, const Real* const* a) override {
            for (int p = 0; p < this->layout.planes; ++p)
                for (int i = first; i < last; ++i) {
                    Real& v = state.v[this->plane(p) + i];
                    v -= Real(0.5) * h * (a[p][i - first] - drag[i] * v);
                }
        }
        Real h;
        const Real* drag;
        State<Real>& state;
    };

    struct Centre final : Sink {
        Centre(const Leapfrog& m, const State<Real>& s, Real* v) : Sink(m, s.layout), state(s), out(v) {}
        void take(int first, int last, const Real* const* a) override {
            for (int p = 0; p < this->layout.planes; ++p)
                for (int i = first; i < last; ++i) {
                    const Real before = state.v[this->plane(p) + i];
                    const auto k = static_cast<std::size_t>(i);
                    const Real after = this->method.keep_[k] * before + this->method.gain_[k] * a[p][i - first];
                    out[this->plane(p) + i] = Real(0.5) * (before + after);
                }
        }
        const State<Real>& state;
        Real* out;
    };

    double h_ = 0;
    LeapfrogUpdate<Real> update_ = nullptr;
    core::AlignedArray<Real> keep_, gain_;
    bool isDragUniform_ = false;
};

template <class Real>
std::unique_ptr<Method<Real>> makeLeapfrog(const MethodOptions& options) {
    if (options.splits) return makeSplitLeapfrog<Real>();
    return std::make_unique<Leapfrog<Real>>();
}

}  // namespace

MethodInfo leapfrog() {
    return {.name = "leapfrog",
            .title = "leap-frog",
            .order = 2,
            .evaluations = 1,
            .storedArrays = 1,
            .symplectic = true,
            .reversible = true,
            .limit = "2 with drag, 2(√(1+4ζ²) - 2ζ) with dashpots",
            .caution = "",
            .largestStep = leapfrogLargestStep,
            .automaticStep = leapfrogLargestStep,
            .make = {makeLeapfrog<float>, makeLeapfrog<double>}};
}

}  // namespace taut::ode
