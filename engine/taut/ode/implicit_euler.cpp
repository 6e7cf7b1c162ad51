// Implicit Euler: v' = v + h a(t + h, x + h v', v'), x' = x + h v'. Order 1. It is stable for any step on linear
// problems, and damps motion that is too fast for the step, ζ_num ≈ z/2.
//
// The first Newton step is Baraff and Witkin's, from the forces at (t + h, x, v):
//
//   [M + hΓ + hC + h²K] Δv = h (F - Γ v) - h² K v,   Γ the drag m γ
//
// K and C lack their parts that are not positive (ImplicitSystem), so that conjugate gradients apply. Held points keep
// Δv = 0. Points moved by hand have a given Δv, and pull at the others. Further Newton steps start from the residual
//
//   G(u) = M (u - v) - h [F(t + h, x + h u, u) - Γ u]
//
// and are halved until it falls: |G|² = Σ G²/m.
//
// If contacts then move points, the step is solved once more, with these points held up along their normals. Otherwise
// springs that only the contact compressed, by up to v h, would add the energy ½ k (v h)². The solve finds the motion
// across the normals, by conjugate gradients in the subspace (Baraff and Witkin's filter), with friction as an impulse.
#include <algorithm>
#include <cmath>

#include "taut/ode/private/implicit_solve.h"

namespace taut::ode {
namespace {

constexpr std::string_view implicitEulerTitle = "implicit Euler";

template <class Real>
class ImplicitEuler final : public Method<Real> {
  public:
    explicit ImplicitEuler(const MethodOptions& options)
        : newtonSteps_(options.newtonSteps),
          newtonTolerance_(std::max(10.0 * options.tolerance, 100.0 * ImplicitMatrix<Real>::finest)),
          matrix_(options) {}

    void start(SecondOrderSystem<Real>& system, double t, double, State<Real>& state) override {
        implicitPartOf(system, implicitEulerTitle);
        prepare(state.layout);
        state.memory.assign(1, core::AlignedArray<Real>(state.layout.size()));
        system.prescribe(t, state.x.data(), state.v.data());
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        if (change_.size() != state.layout.size()) prepare(state.layout);  // another object started this state
        std::copy(state.x.begin(), state.x.end(), start_.x.begin());
        std::copy(state.v.begin(), state.v.end(), start_.v.begin());
        Step now{system, implicitPartOf(system, implicitEulerTitle), t + h, h, state};
        solve(now);
        for (std::size_t i = 0; i < state.v.size(); ++i) {
            state.memory[0][i] = u_[i] - state.v[i];
            state.v[i] = u_[i];
        }
        const Real* inverseMass = now.linear.inverseMasses();
        forEachNumber(state.layout, [&](std::size_t at, std::size_t i) {
            if (inverseMass[i] > Real(0)) state.x[at] += static_cast<Real>(h) * u_[at];
        });
        system.prescribe(t + h, state.x.data(), state.v.data());
    }

    bool yields() const override { return true; }
    void yield(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state,
               std::span<Support> supports) override {
        using Hold = typename Supports<Real>::Hold;
        const Step now{system, implicitPartOf(system, implicitEulerTitle), t + h, h, start_};
        supports_.take(supports, state.x.data());
        std::copy(state.memory[0].begin(), state.memory[0].end(), start_.memory[0].begin());
        solve(now);
        forEachNumber(
            state.layout,
            [&](std::size_t at, std::size_t i) {
                if (!isFree(now, i)) return;
                state.memory[0][at] = u_[at] - start_.v[at];
                state.x[at] = start_.x[at] + static_cast<Real>(h) * u_[at];
                if (supports_.holdOf(i) == Hold::none) state.v[at] = u_[at];
            });
        supports_.forEachAlong([&](const Support& support) {
            const double off = supports_.along(support, state.v.data()) - supports_.along(support, u_.data());
            supports_.forEachPlane(
                support, [&](std::size_t at, double n) { state.v[at] = u_[at] + static_cast<Real>(off * n); });
        });
        supports_.release();
    }

    void synchronise(SecondOrderSystem<Real>&, double, double, const State<Real>& state, Real* v) override {
        std::copy(state.v.begin(), state.v.end(), v);
    }

    void touch(State<Real>& state, std::span<const int> points) override {
        for (int p = 0; p < state.layout.planes; ++p)
            for (int i : points) state.memory[0][static_cast<std::ptrdiff_t>(p) * state.layout.stride + i] = 0;
    }

  private:
    struct Step {
        SecondOrderSystem<Real>& system;
        ImplicitSystem<Real>& linear;
        double end, h;  // [s]
        const State<Real>& state;
    };

    void prepare(Layout layout) {
        const std::size_t n = layout.size();
        start_ = State<Real>(layout);
        start_.memory.assign(1, core::AlignedArray<Real>(n));
        supports_.resize(layout);
        change_ = b_ = u_ = trial_ = place_ = acceleration_ = scratch_ = core::AlignedArray<Real>(n);
        matrix_.resize(n);
    }

    void accelerate(const Step& now, const Real* x, const Real* v) {
        StoreAccelerations<Real> store(now.state.layout, acceleration_.data());
        now.system.accelerate(now.end, x, v, store);
        ++this->work_.evaluations;
    }

    // Solves A change_ = b_, A = M + hΓ + hC + h²K at (x, v), from the guess in change_.
    void solve(const Step& now, const Real* x, const Real* v) {
        matrix_.fix(now.system, now.end, x, v, now.h, &supports_);
        matrix_.solve(b_, change_, supports_, this->work_);
    }

    // Computes the velocities at the end -> u_.
    void solve(const Step& now) {
        const double scale = firstNewtonStep(now);
        if (newtonSteps_ > 1) refine(now, scale);
    }

    bool isFree(const Step& now, std::size_t i) const {
        return now.linear.inverseMasses()[i] > Real(0) && supports_.isFree(i);
    }

    // Baraff and Witkin's step -> u_. Returns the norm of its right-hand side.
    double firstNewtonStep(const Step& now) {
        const State<Real>& state = now.state;
        const Real h = static_cast<Real>(now.h);
        const Real *mass = now.linear.masses(), *drag = now.system.dragRates();
        accelerate(now, state.x.data(), state.v.data());
        std::fill(scratch_.begin(), scratch_.end(), Real(0));
        now.linear.linearise(now.end, state.x.data(), state.v.data(), now.h * now.h, 0.0);
        now.linear.addProduct(state.v.data(), scratch_.data());
        ++this->work_.iterations;
        // Points that are moved by hand get the velocity that takes them to their place, x + h u.
        std::copy(state.x.begin(), state.x.end(), place_.begin());
        std::copy(state.v.begin(), state.v.end(), trial_.begin());
        now.system.prescribe(now.end, place_.data(), trial_.data());
        std::fill(b_.begin(), b_.end(), Real(0));
        forEachNumber(state.layout, [&](std::size_t at, std::size_t i) {
            if (isFree(now, i)) {
                b_[at] = h * (mass[i] * acceleration_[at] - mass[i] * drag[i] * state.v[at]) - scratch_[at] +
                         mass[i] * supports_.rubbed(at);
                change_[at] = state.memory[0][at];
            } else {
                const Real end = supports_.isFree(i) ? place_[at] : supports_.given(at);
                change_[at] = (end - state.x[at]) / h - state.v[at];
            }
        });
        // Points held along a normal get the change along it that takes them to where the contact put them.
        supports_.forEachAlong([&](const Support& support) {
            const auto part = [&](const Real* rows) { return supports_.along(support, rows); };
            const double wanted = (part(supports_.given()) - part(state.x.data())) / now.h - part(state.v.data());
            supports_.addAlong(support, wanted - part(change_.data()), change_.data());
        });
        const double scale = massNorm(now, b_.data());
        if (!passOnWhatIsNoNumber(b_, change_, this->work_)) solve(now, state.x.data(), state.v.data());
        for (std::size_t i = 0; i < u_.size(); ++i) u_[i] = state.v[i] + change_[i];
        return scale;
    }

    // Makes Newton steps from u_ on, until the residual is small against the scale or the residual of the first step,
    // whichever is larger.
    void refine(const Step& now, double scale) {
        double norm = residual(now, u_.data());
        const double target = newtonTolerance_ * std::max(scale, norm);
        for (int n = 1; n < newtonSteps_ && norm > target; ++n) {
            std::fill(change_.begin(), change_.end(), Real(0));
            solve(now, place_.data(), u_.data());
            double part = 1.0, next = norm;
            for (int halving = 0; halving < 12; ++halving, part *= 0.5) {
                for (std::size_t i = 0; i < u_.size(); ++i) trial_[i] = u_[i] + static_cast<Real>(part) * change_[i];
                next = residual(now, trial_.data());
                if (next < norm) break;
            }
            if (!(next < norm)) break;
            std::swap(u_, trial_);
            norm = next;
        }
        if (!(norm <= target)) ++this->work_.unconverged;
    }

    // Computes -G(u) -> b_ and x + h u -> place_. Returns |G|.
    double residual(const Step& now, const Real* u) {
        const State<Real>& state = now.state;
        const Real h = static_cast<Real>(now.h);
        const Real *mass = now.linear.masses(), *drag = now.system.dragRates();
        for (std::size_t i = 0; i < u_.size(); ++i) place_[i] = state.x[i] + h * u[i];
        now.system.prescribe(now.end, place_.data(), nullptr);
        accelerate(now, place_.data(), u);
        std::fill(b_.begin(), b_.end(), Real(0));
        forEachNumber(state.layout, [&](std::size_t at, std::size_t i) {
            if (!isFree(now, i)) return;
            b_[at] = mass[i] * (state.v[at] + supports_.rubbed(at) - u[at] + h * (acceleration_[at] - drag[i] * u[at]));
        });
        supports_.flatten(b_.data());
        return massNorm(now, b_.data());
    }

    double massNorm(const Step& now, const Real* b) {
        const Layout layout = now.state.layout;
        double sum = 0.0;
        for (int p = 0; p < layout.planes; ++p) {
            const Real* plane = b + static_cast<std::ptrdiff_t>(p) * layout.stride;
            sum += weightedSum(static_cast<std::size_t>(layout.count), now.linear.inverseMasses(), plane, plane);
        }
        return std::sqrt(sum);
    }

    int newtonSteps_;
    double newtonTolerance_;
    ImplicitMatrix<Real> matrix_;
    State<Real> start_;                    // at the start of the last step
    Supports<Real> supports_;              // during yield()
    core::AlignedArray<Real> change_, b_;  // Δv, unknown of the solve; right-hand side
    core::AlignedArray<Real> u_, trial_;   // v', and the one on trial
    core::AlignedArray<Real> place_;       // x + h u
    core::AlignedArray<Real> acceleration_, scratch_;
};

template <class Real>
std::unique_ptr<Method<Real>> makeImplicitEuler(const MethodOptions& options) {
    return std::make_unique<ImplicitEuler<Real>>(options);
}

}  // namespace

MethodInfo implicitEuler() {
    return {.name = "implicit-euler",
            .title = implicitEulerTitle,
            .order = 1,
            .evaluations = 1,
            .storedArrays = 19,
            .symplectic = false,
            .reversible = false,
            .limit = "none on linear problems; solves by conjugate gradients, and damps by ζ = z/2",
            .caution = "",
            .largestStep = unlimitedStep,
            .automaticStep = unlimitedStep,
            .make = {makeImplicitEuler<float>, makeImplicitEuler<double>}};
}

}  // namespace taut::ode
