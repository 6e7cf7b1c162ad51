// Implicit Euler: v' = v + h a(t + h, x + h v', v'), x' = x + h v'. Order 1; stands any step on linear problems and
// damps what it cannot follow, ζ_num ≈ z/2.
//
// The first Newton step is Baraff and Witkin's, from the forces at (t + h, x, v):
//
//   [M + hΓ + hC + h²K] Δv = h (F - Γ v) - h² K v,   Γ the drag m γ
//
// with K and C without what is not positive in them (ImplicitSystem), so that conjugate gradients apply. Held points
// keep Δv = 0; points moved by hand have theirs given, and pull at the others. Further Newton steps start from the
// residual
//
//   G(u) = M (u - v) - h [F(t + h, x + h u, u) - Γ u]
//
// and are halved until it falls: |G|² = Σ G²/m.
#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/ode/conjugate_gradient.h"
#include "taut/ode/implicit_system.h"
#include "taut/ode/method.h"

namespace taut::ode {
namespace {

template <class Real>
class ImplicitEuler final : public Method<Real> {
  public:
    explicit ImplicitEuler(const MethodOptions& options) : options_(options), solver_(0) {
        TAUT_EXPECTS(options.newtonSteps >= 1 && options.tolerance > 0.0 && options.maxIterations >= 1);
        constexpr double finest = sizeof(Real) < sizeof(double) ? 1e-6 : 1e-14;
        tolerance_ = std::max(options.tolerance, finest);
        newtonTolerance_ = std::max(10.0 * options.tolerance, 100.0 * finest);
    }

    void start(SecondOrderSystem<Real>& system, double t, double, State<Real>& state) override {
        linearOf(system);
        prepare(state.layout);
        state.memory.assign(1, core::AlignedArray<Real>(state.layout.size()));
        system.prescribe(t, state.x.data(), state.v.data());
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        if (change_.size() != state.layout.size()) prepare(state.layout);  // a state that another one started
        Step now{system, linearOf(system), t + h, h, state};
        const double scale = firstNewtonStep(now);
        if (options_.newtonSteps > 1) refine(now, scale);
        for (std::size_t i = 0; i < state.v.size(); ++i) {
            state.memory[0][i] = u_[i] - state.v[i];
            state.v[i] = u_[i];
        }
        const Real* inverseMass = now.linear.inverseMasses();
        forEach(state.layout, [&](std::size_t at, std::size_t i) {
            if (inverseMass[i] > Real(0)) state.x[at] += static_cast<Real>(h) * u_[at];
        });
        system.prescribe(t + h, state.x.data(), state.v.data());
    }

    void synchronise(SecondOrderSystem<Real>&, double, double, const State<Real>& state, Real* v) override {
        std::copy(state.v.begin(), state.v.end(), v);
    }

    void touch(State<Real>& state, std::span<const int> points) override {
        for (int p = 0; p < state.layout.planes; ++p)
            for (int i : points)
                state.memory[0][static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) * state.layout.stride + i)] = 0;
    }

  private:
    struct Step {
        SecondOrderSystem<Real>& system;
        ImplicitSystem<Real>& linear;
        double end, h;  // [s]
        const State<Real>& state;
    };

    class Store final : public AccelerationSink<Real> {
      public:
        Store(Layout layout, Real* out) : layout_(layout), out_(out) {}
        void take(int first, int last, const Real* const* a) override {
            for (int p = 0; p < layout_.planes; ++p)
                std::copy_n(a[p], last - first, out_ + static_cast<std::ptrdiff_t>(p) * layout_.stride + first);
        }

      private:
        Layout layout_;
        Real* out_;
    };

    template <class F>
    static void forEach(Layout layout, F&& f) {
        for (int p = 0; p < layout.planes; ++p)
            for (int i = 0; i < layout.count; ++i)
                f(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) * layout.stride + i),
                  static_cast<std::size_t>(i));
    }

    static ImplicitSystem<Real>& linearOf(SecondOrderSystem<Real>& system) {
        if (ImplicitSystem<Real>* linear = system.implicitPart()) return *linear;
        throw core::Error(core::ErrorKind::usage,
                          "implicit Euler needs a system that gives masses and the derivatives of its forces");
    }

    void prepare(Layout layout) {
        const std::size_t n = layout.size();
        change_ = b_ = inverse_ = u_ = trial_ = place_ = acceleration_ = scratch_ = core::AlignedArray<Real>(n);
        solver_ = ConjugateGradient<Real>(n);
    }

    void accelerate(const Step& now, const Real* x, const Real* v) {
        Store store(now.state.layout, acceleration_.data());
        now.system.accelerate(now.end, x, v, store);
        ++this->work_.evaluations;
    }

    // Solves A change_ = b_, A = M + hΓ + hC + h²K at (x, v), from the given guess.
    Solution solve(const Step& now, const Real* x, const Real* v) {
        const double h = now.h;
        const Layout layout = now.state.layout;
        const Real *mass = now.linear.masses(), *inverseMass = now.linear.inverseMasses(),
                   *drag = now.system.dragRates();
        now.linear.linearise(now.end, x, v, h * h, h);
        std::fill(inverse_.begin(), inverse_.end(), Real(0));
        now.linear.addDiagonal(inverse_.data());
        const Real step = static_cast<Real>(h);
        forEach(
            layout,
            [&](std::size_t at, std::size_t i) {
                const Real own = mass[i] * (Real(1) + step * drag[i]);
                inverse_[at] = inverseMass[i] > Real(0) ? Real(1) / (inverse_[at] + own) : Real(0);
            });
        const auto multiply = [&](const Real* in, Real* out) {
            std::fill_n(out, layout.size(), Real(0));
            forEach(layout,
                    [&](std::size_t at, std::size_t i) { out[at] = mass[i] * (Real(1) + step * drag[i]) * in[at]; });
            now.linear.addProduct(in, out);
        };
        const Solution solution =
            solver_.solve(multiply, inverse_.data(), b_.data(), tolerance_, options_.maxIterations, change_.data());
        this->work_.iterations += solution.products;
        if (!solution.converged) ++this->work_.unconverged;
        return solution;
    }

    // Baraff and Witkin's step into u_; the norm of its right-hand side.
    double firstNewtonStep(const Step& now) {
        const State<Real>& state = now.state;
        const Real h = static_cast<Real>(now.h);
        const Real *mass = now.linear.masses(), *inverseMass = now.linear.inverseMasses(),
                   *drag = now.system.dragRates();
        accelerate(now, state.x.data(), state.v.data());
        std::fill(scratch_.begin(), scratch_.end(), Real(0));
        now.linear.linearise(now.end, state.x.data(), state.v.data(), now.h * now.h, 0.0);
        now.linear.addProduct(state.v.data(), scratch_.data());
        ++this->work_.iterations;
        // Where points that are moved by hand will be gives their velocity, so that x + h u is there.
        place_ = state.x;
        trial_ = state.v;
        now.system.prescribe(now.end, place_.data(), trial_.data());
        std::fill(b_.begin(), b_.end(), Real(0));
        forEach(state.layout, [&](std::size_t at, std::size_t i) {
            if (inverseMass[i] > Real(0)) {
                b_[at] = h * (mass[i] * acceleration_[at] - mass[i] * drag[i] * state.v[at]) - scratch_[at];
                change_[at] = state.memory[0][at];
            } else {
                change_[at] = (place_[at] - state.x[at]) / h - state.v[at];
            }
        });
        const double scale = massNorm(now, b_.data());
        if (!passOnWhatIsNoNumber()) solve(now, state.x.data(), state.v.data());
        for (std::size_t i = 0; i < u_.size(); ++i) u_[i] = state.v[i] + change_[i];
        return scale;
    }

    // A force that is not a number cannot be solved for, and the solver would leave all where it is, unseen: it goes
    // into the velocity of its point, where whoever looks at the state finds it.
    bool passOnWhatIsNoNumber() {
        bool isThere = false;
        for (std::size_t i = 0; i < b_.size(); ++i)
            if (!std::isfinite(b_[i])) {
                change_[i] = b_[i];
                isThere = true;
            }
        if (isThere) ++this->work_.unconverged;
        return isThere;
    }

    // Newton steps on from u_ until the residual is small against the scale, or what the first step has left.
    void refine(const Step& now, double scale) {
        double norm = residual(now, u_.data());
        const double target = newtonTolerance_ * std::max(scale, norm);
        for (int n = 1; n < options_.newtonSteps && norm > target; ++n) {
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

    // -G(u) into b_, x + h u into place_; |G|.
    double residual(const Step& now, const Real* u) {
        const State<Real>& state = now.state;
        const Real h = static_cast<Real>(now.h);
        const Real *mass = now.linear.masses(), *inverseMass = now.linear.inverseMasses(),
                   *drag = now.system.dragRates();
        for (std::size_t i = 0; i < u_.size(); ++i) place_[i] = state.x[i] + h * u[i];
        now.system.prescribe(now.end, place_.data(), nullptr);
        accelerate(now, place_.data(), u);
        std::fill(b_.begin(), b_.end(), Real(0));
        forEach(state.layout, [&](std::size_t at, std::size_t i) {
            if (!(inverseMass[i] > Real(0))) return;
            b_[at] = mass[i] * (state.v[at] - u[at] + h * (acceleration_[at] - drag[i] * u[at]));
        });
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

    MethodOptions options_;
    double tolerance_, newtonTolerance_;
    ConjugateGradient<Real> solver_;
    core::AlignedArray<Real> change_;       // Δv, unknown of the solve
    core::AlignedArray<Real> b_, inverse_;  // right-hand side; inverse of the diagonal, 0 for held points
    core::AlignedArray<Real> u_, trial_;    // v', and the one in question
    core::AlignedArray<Real> place_;        // x + h u
    core::AlignedArray<Real> acceleration_, scratch_;
};

template <class Real>
std::unique_ptr<Method<Real>> makeImplicitEuler(const MethodOptions& options) {
    return std::make_unique<ImplicitEuler<Real>>(options);
}

double implicitEulerLargestStep(const FastestMode&) {
    return HUGE_VAL;
}

}  // namespace

MethodInfo implicitEuler() {
    return {.name = "implicit-euler",
            .title = "implicit Euler",
            .order = 1,
            .evaluations = 1,
            .storedArrays = 12,
            .symplectic = false,
            .reversible = false,
            .limit = "none on linear problems; solves by conjugate gradients, and damps by ζ = z/2",
            .caution = "",
            .largestStep = implicitEulerLargestStep,
            .automaticStep = implicitEulerLargestStep,
            .make = {makeImplicitEuler<float>, makeImplicitEuler<double>}};
}

}  // namespace taut::ode
