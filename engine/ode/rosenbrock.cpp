// A linearly implicit method of order 2 (a W-method, after Rosenbrock; Steihaug and Wolfbrandt 1979), for y = (x, v),
// y' = f(t, y):
//
//   [I - γh J] k1 = f(t, y),   [I - γh J] k2 = f(t + γh, y + γh k1) - 2γ k1
//   y' = y + h [(2 - 1/2γ) k1 + 1/2γ k2],   γ = 1 - 1/√2
//
// It is of order 2 whatever J is, so that K and C may lack what is not positive in them (ImplicitSystem). With the true
// J its stability function is that of SDIRK2, R(w) = (1 + (1 - 2γ) w)/(1 - γw)²: it stands any step on linear problems,
// and what is too fast for the step dies out. So does it at the second place where the force is asked for, which other
// places of the same order would throw far off: on cloth at h = 1/60 s, f(t + h, y + h k1) ends in pieces.
// With s = γh, and r what stands on the right:
//
//   [M + sΓ + sC + s²K] k_v = M r_v - s K r_x,   k_x = r_x + s k_v,   Γ the drag m γ
#include <algorithm>
#include <cmath>

#include "taut/ode/implicit_solve.h"

namespace taut::ode {
namespace {

constexpr std::string_view rosenbrockTitle = "Rosenbrock";

template <class Real>
class Rosenbrock final : public Method<Real> {
  public:
    explicit Rosenbrock(const MethodOptions& options) : matrix_(options) {}

    void start(SecondOrderSystem<Real>& system, double t, double, State<Real>& state) override {
        implicitPartOf(system, rosenbrockTitle);
        prepare(state.layout);
        state.memory.clear();
        system.prescribe(t, state.x.data(), state.v.data());
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        if (matrix_.size() != state.layout.size()) prepare(state.layout);  // a state that another one started
        implicitPartOf(system, rosenbrockTitle);
        lead(system, t + h, h, state);
        const double s = gamma * h;

        speed_ = state.v;
        evaluate(system, t, state.x.data(), state.v.data());
        solve(system, t, s, state, first_);
        const Real *first = first_.data(), *v = state.v.data();
        for (std::size_t i = 0; i < slope_.size(); ++i) {
            slope_[i] = v[i] + static_cast<Real>(s) * first[i];
            place_[i] = state.x[i] + static_cast<Real>(s) * slope_[i];
            speed_[i] = slope_[i];
        }
        system.prescribe(t + s, place_.data(), speed_.data());
        evaluate(system, t + s, place_.data(), speed_.data());
        for (std::size_t i = 0; i < slope_.size(); ++i) {
            speed_[i] -= static_cast<Real>(2 * gamma) * slope_[i];
            force_[i] -= static_cast<Real>(2 * gamma) * first[i];
        }
        solve(system, t, s, state, second_);
        finish(system, h, state);
        system.prescribe(t + h, state.x.data(), state.v.data());
    }

    void synchronise(SecondOrderSystem<Real>&, double, double, const State<Real>& state, Real* v) override {
        std::copy(state.v.begin(), state.v.end(), v);
    }

    void touch(State<Real>&, std::span<const int>) override {}

  private:
    static constexpr double gamma = 0.29289321881345248;  // 1 - 1/√2

    void prepare(Layout layout) {
        matrix_.resize(layout.size());
        first_ = second_ = force_ = place_ = speed_ = slope_ = b_ = core::AlignedArray<Real>(layout.size());
    }

    // The first guesses: nothing, from which the first iteration of a solve leads as far as a step before, or, of what
    // is moved by hand, slopes that take its velocity to that of the end.
    void lead(SecondOrderSystem<Real>& system, double end, double h, const State<Real>& state) {
        place_ = state.x;
        speed_ = state.v;
        system.prescribe(end, place_.data(), speed_.data());
        std::fill(first_.begin(), first_.end(), Real(0));
        std::fill(second_.begin(), second_.end(), Real(0));
        const Real* inverseMass = system.implicitPart()->inverseMasses();
        forEachNumber(state.layout, [&](std::size_t at, std::size_t i) {
            if (inverseMass[i] > Real(0)) return;
            first_[at] = (speed_[at] - state.v[at]) / static_cast<Real>(h);
            second_[at] = static_cast<Real>(1 - 2 * gamma) * first_[at];
        });
    }

    // a - γ v, with γ the drag, into force_.
    void evaluate(SecondOrderSystem<Real>& system, double t, const Real* x, const Real* v) {
        const Layout layout = system.layout();
        StoreAccelerations<Real> store(layout, force_.data());
        system.accelerate(t, x, v, store);
        ++this->work_.evaluations;
        const Real* drag = system.dragRates();
        forEachNumber(layout, [&](std::size_t at, std::size_t i) { force_[at] -= drag[i] * v[at]; });
    }

    // k_v from r_x in speed_ and r_v in force_.
    void solve(SecondOrderSystem<Real>& system, double t, double s, const State<Real>& state,
               core::AlignedArray<Real>& k) {
        ImplicitSystem<Real>& implicit = *system.implicitPart();
        std::fill(b_.begin(), b_.end(), Real(0));
        implicit.linearise(t, state.x.data(), state.v.data(), s, 0.0);
        implicit.addProduct(speed_.data(), b_.data());
        ++this->work_.iterations;
        const Real *mass = implicit.masses(), *inverseMass = implicit.inverseMasses();
        forEachNumber(state.layout, [&](std::size_t at, std::size_t i) {
            b_[at] = inverseMass[i] > Real(0) ? mass[i] * force_[at] - b_[at] : Real(0);
        });
        if (passOnWhatIsNoNumber(b_, k, this->work_)) return;
        matrix_.fix(system, t, state.x.data(), state.v.data(), s);
        matrix_.solve(b_.data(), k.data(), this->work_);
    }

    void finish(SecondOrderSystem<Real>& system, double h, State<Real>& state) {
        const Real one = static_cast<Real>((2 - 0.5 / gamma) * h), two = static_cast<Real>(0.5 / gamma * h),
                   s = static_cast<Real>(gamma * h);
        const Real* inverseMass = system.implicitPart()->inverseMasses();
        forEachNumber(state.layout, [&](std::size_t at, std::size_t i) {
            if (!(inverseMass[i] > Real(0))) return;
            const Real first = first_[at], second = second_[at];
            state.x[at] += one * slope_[at] + two * (speed_[at] + s * second);
            state.v[at] += one * first + two * second;
        });
    }

    ImplicitMatrix<Real> matrix_;
    core::AlignedArray<Real> first_, second_;  // k1_v, k2_v
    core::AlignedArray<Real> force_;           // a - γ v; then r_v
    core::AlignedArray<Real> place_, speed_;   // of a stage; then r_x
    core::AlignedArray<Real> slope_, b_;       // k1_x; right-hand side
};

template <class Real>
std::unique_ptr<Method<Real>> makeRosenbrock(const MethodOptions& options) {
    return std::make_unique<Rosenbrock<Real>>(options);
}

double rosenbrockLargestStep(const FastestMode&) {
    return HUGE_VAL;
}

}  // namespace

MethodInfo rosenbrock() {
    return {
        .name = "rosenbrock",
        .title = rosenbrockTitle,
        .order = 2,
        .evaluations = 2,
        .storedArrays = 11,
        .symplectic = false,
        .reversible = false,
        .limit = "none on linear problems; two solves a step by conjugate gradients, and damps what is too fast for it",
        .caution = "",
        .largestStep = rosenbrockLargestStep,
        .automaticStep = rosenbrockLargestStep,
        .make = {makeRosenbrock<float>, makeRosenbrock<double>}};
}

}  // namespace taut::ode
