// Leap-frog with strong damping split off. Its limit is ω h < 2 for any dashpots.
//
//   v⁺ = D* R D v⁻,   x' = x + h v⁺,   w' = 1.5 v⁺ - 0.5 v⁻
//
// Why split. A dashpot c damps the velocity of a pair of points at a rate c (w_a + w_b). An explicit step is unstable
// once h times this rate is large. So a strong dashpot sets the step although it moves nothing. An implicit step would
// have to solve for all points at once.
//
// The split. The kick, at fixed positions, solves v' = A v + r(t, x, v) - γ v. A is the sum of the dashpots. Each
// dashpot acts on only two points, so each alone is solved in closed form (mechanics/dashpot_sweep.h).
//   D    half a step of most dashpots, one after the other
//   R    a whole step of the forces r and the drag γ, which constraints share out; then of dashpots solved as chains
//   D*   half a step of the dashpots of D, in the opposite order: the adjoint of D
//
// The order. D alone composes flows that do not commute: order 1 (Lie and Trotter). D* R D is the same in
// both directions if R is, and a symmetric method has even order: 2 (Strang 1968; Hairer, Lubich and Wanner, Geometric
// Numerical Integration, II.5). In R, drag takes the mean of the velocities before and after it, and chains take the
// mean of the velocities before the kick and after the chains. Each alone is symmetric. If drag and chains act on the
// same points, an error of first order remains: γ h/2 of the effect of the chains. Forces that depend on velocity take
// w, which is extrapolated to the time of the positions with an error O(h²).
//
// Why it is stable. D and D* never raise the kinetic energy, for any h and any c. Without them the method is leap-frog.
// For large h c they are wrong only in how fast they damp. So the dashpots limit the step by accuracy, not by stability
// (island/step_choice.cpp).
//
// The first kick is half as long. From then on v lags by half a step, as in leap-frog.
#include <algorithm>

#include "taut/ode/method.h"
#include "taut/ode/private/leapfrog_parts.h"
#include "taut/ode/split_system.h"

namespace taut::ode {
namespace {

template <class Real>
class SplitLeapfrog final : public Method<Real> {
  public:
    void start(SecondOrderSystem<Real>& system, double t, double, State<Real>& state) override {
        system.splitPart()->split(true);
        system.prescribe(t, state.x.data(), state.v.data());
        state.memory.resize(2);
        state.memory[0] = state.v;
        state.memory[1] = core::AlignedArray<Real>(1);
        state.memory[1][0] = 1;
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        if (before_.size() != state.v.size()) before_ = core::AlignedArray<Real>(state.v.size());
        std::copy(state.v.begin(), state.v.end(), before_.begin());
        const bool isFirst = isAtStart(state);
        kick(system, t, isFirst ? 0.5 * h : h, state, state.v.data());
        drift(h, isFirst ? Real(1) : Real(0.5), state);
        state.memory[1][0] = 0;
        system.prescribe(t + h, state.x.data(), state.memory[0].data());
        system.prescribe(t + 0.5 * h, nullptr, state.v.data());
        ++this->work_.evaluations;
    }

    // Adds half of the next kick.
    void synchronise(SecondOrderSystem<Real>& system, double t, double h, const State<Real>& state, Real* v) override {
        std::copy(state.v.begin(), state.v.end(), v);
        if (isAtStart(state)) return;
        kick(system, t, 0.5 * h, state, v);
        system.prescribe(t, nullptr, v);
        ++this->work_.evaluations;
    }

    void touch(State<Real>& state, std::span<const int> points) override { takeAsPredicted(state, points); }
    const Real* predicted(const State<Real>& state) const override { return state.memory[0].data(); }

  private:
    static bool isAtStart(const State<Real>& state) { return state.memory[1][0] != Real(0); }

    struct Rest final : AccelerationSink<Real> {
        Rest(Layout shape, const Real* drags, Real step, Real* velocities)
            : layout(shape), drag(drags), h(step), v(velocities) {}
        void take(int first, int last, const Real* const* a) override {
            for (int p = 0; p < layout.planes; ++p) {
                Real* at = v + static_cast<std::ptrdiff_t>(p) * layout.stride;
                for (int i = first; i < last; ++i) {
                    const Real b = Real(0.5) * h * drag[i];
                    at[i] = ((Real(1) - b) * at[i] + h * a[p][i - first]) / (Real(1) + b);
                }
            }
        }
        Layout layout;
        const Real* drag;
        Real h;
        Real* v;
    };

    void kick(SecondOrderSystem<Real>& system, double t, double h, const State<Real>& state, Real* v) {
        SplitSystem<Real>& split = *system.splitPart();
        Rest rest(state.layout, system.dragRates(), static_cast<Real>(h), v);
        split.dampBefore(h, state.x.data(), v);
        system.accelerate(t, state.x.data(), state.memory[0].data(), rest);
        split.shareOut(t, v);
        split.dampBetween(state.x.data(), v);
        split.dampAfter(state.x.data(), v);
    }

    // ahead: the share of this kick's change that takes v on to the end of the step.
    void drift(double h, Real ahead, State<Real>& state) {
        const Real step = static_cast<Real>(h);
        Real *x = state.x.data(), *v = state.v.data(), *w = state.memory[0].data();
        const Real* before = before_.data();
        for (std::size_t i = 0; i < state.v.size(); ++i) {
            w[i] = v[i] + ahead * (v[i] - before[i]);
            x[i] += step * v[i];
        }
    }

    core::AlignedArray<Real> before_;  // scratch
};

}  // namespace

template <class Real>
std::unique_ptr<Method<Real>> makeSplitLeapfrog() {
    return std::make_unique<SplitLeapfrog<Real>>();
}
template std::unique_ptr<Method<float>> makeSplitLeapfrog();
template std::unique_ptr<Method<double>> makeSplitLeapfrog();

}  // namespace taut::ode
