// SDIRK2, the singly diagonally implicit Runge-Kutta method of order 2 that is L-stable (Alexander 1977), for
// y = (x, v), y' = f(t, y), with γ = 1 - 1/√2:
//
//   y1 = y + γh f(t + γh, y1),   y' = y + (1 - γ)h f(t + γh, y1) + γh f(t + h, y')
//
// It is stable for any step on linear problems, and motion that is too fast for the step dies out. Each stage is a step
// of implicit Euler by s = γh, the second one from y + (1/γ - 1)(y1 - y). A stage makes one Newton step for G(u) = 0,
//
//   G(u) = M (u - v) - s [F(x + s u, u) - Γ u],   Γ the drag m γ
//
// It starts from u_0, which is v or the velocity of the first stage. It takes the forces at X = x + s u_0 and at a
// velocity w that the last slope predicts:
//
//   [M + sΓ + sC + s²K] Δu = M (v - u_0) + s [F(X, w) - Γ u_0 - C (u_0 - w)]
//
// K and C at (X, w) lack their parts that are not positive, and for wind C lacks more (ImplicitSystem). F is complete,
// so the order is still 2: the missing part of K acts on Δu = O(h) with s², the missing part of C on u - w = O(h²) with
// s. The forces are taken where the points will be, so a stage also undoes most of the stretch that motion across a
// spring causes. This keeps very stiff springs calm. Places predicted by a slope would be off by more than that.
#include <algorithm>

#include "taut/ode/private/implicit_solve.h"

namespace taut::ode {
namespace {

constexpr std::string_view sdirk2Title = "SDIRK2";

template <class Real>
class Sdirk2 final : public Method<Real> {
    static constexpr double gamma = 0.29289321881345248;  // 1 - 1/√2
    using Planes = core::AlignedArray<Real>;

  public:
    explicit Sdirk2(const MethodOptions& options) : matrix_(options) {}

    void start(SecondOrderSystem<Real>& system, double t, double, State<Real>& state) override {
        implicitPartOf(system, sdirk2Title);
        state.memory.assign(1, Planes(state.layout.size()));  // the last slope; 0: not known
        system.prescribe(t, state.x.data(), state.v.data());
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        if (matrix_.size() != state.layout.size()) prepare(state.layout);  // another object started this state
        implicitPartOf(system, sdirk2Title);
        std::copy(state.v.begin(), state.v.end(), u_.begin());
        for (std::size_t i = 0; i < u_.size(); ++i)
            seen_[i] = state.v[i] + static_cast<Real>(gamma * h) * state.memory[0][i];
        // The first stage, then the second from the first one's change.
        stage(system, t + gamma * h, gamma * h, state.x, state.v);
        const Real ahead = static_cast<Real>(1 / gamma - 1);
        for (std::size_t i = 0; i < u_.size(); ++i) {
            const Real change = u_[i] - state.v[i];
            x_[i] = state.x[i] + ahead * (place_[i] - state.x[i]);
            v_[i] = state.v[i] + ahead * change;
            seen_[i] = u_[i] + ahead * change;
        }
        stage(system, t + h, gamma * h, x_, v_);
        const Real* inverseMass = system.implicitPart()->inverseMasses();
        forEachNumber(state.layout, [&](std::size_t at, std::size_t i) {
            if (!(inverseMass[i] > Real(0))) return;
            state.memory[0][at] = (u_[at] - v_[at]) / static_cast<Real>(gamma * h);
            state.x[at] = place_[at];
            state.v[at] = u_[at];
        });
        system.prescribe(t + h, state.x.data(), state.v.data());
    }

    void synchronise(SecondOrderSystem<Real>&, double, double, const State<Real>& state, Real* v) override {
        std::copy(state.v.begin(), state.v.end(), v);
    }

    void touch(State<Real>& state, std::span<const int> points) override {
        for (int p = 0; p < state.layout.planes; ++p)
            for (int i : points) state.memory[0][static_cast<std::ptrdiff_t>(p) * state.layout.stride + i] = 0;
    }

  private:
    void prepare(Layout layout) {
        matrix_.resize(layout.size());
        x_ = v_ = u_ = seen_ = place_ = force_ = b_ = change_ = Planes(layout.size());
    }

    // Solves a stage at t, from the guess u_ -> u_ and place_ = x + s u_.
    void stage(SecondOrderSystem<Real>& system, double t, double s, const Planes& x, const Planes& v) {
        // The forces at X = place_ and w = seen_.
        const Real step = static_cast<Real>(s);
        const Layout layout = system.layout();
        for (std::size_t i = 0; i < u_.size(); ++i) place_[i] = x[i] + step * u_[i];
        system.prescribe(t, place_.data(), u_.data());
        system.prescribe(t, nullptr, seen_.data());
        StoreAccelerations<Real> store(layout, force_.data());
        system.accelerate(t, place_.data(), seen_.data(), store);
        ++this->work_.evaluations;

        // The right-hand side, then the Newton step.
        ImplicitSystem<Real>& implicit = *system.implicitPart();
        const Real *mass = implicit.masses(), *inverseMass = implicit.inverseMasses(), *drag = system.dragRates();
        for (std::size_t i = 0; i < u_.size(); ++i) change_[i] = u_[i] - seen_[i];
        std::fill(b_.begin(), b_.end(), Real(0));
        implicit.linearise(t, place_.data(), seen_.data(), 0.0, s);
        implicit.addProduct(change_.data(), b_.data());
        ++this->work_.iterations;
        std::fill(change_.begin(), change_.end(), Real(0));
        forEachNumber(layout, [&](std::size_t at, std::size_t i) {
            const Real pull = v[at] - u_[at] + step * (force_[at] - drag[i] * u_[at]);
            b_[at] = inverseMass[i] > Real(0) ? mass[i] * pull - b_[at] : Real(0);
        });
        if (!passOnWhatIsNoNumber(b_, change_, this->work_)) {
            matrix_.fix(system, t, place_.data(), seen_.data(), s);
            matrix_.solve(b_.data(), change_.data(), this->work_);
        }
        for (std::size_t i = 0; i < u_.size(); ++i) {
            u_[i] += change_[i];
            place_[i] += step * change_[i];
        }
    }

    ImplicitMatrix<Real> matrix_;
    Planes x_, v_;       // start of the second stage
    Planes u_, seen_;    // velocities of a stage, and w
    Planes place_;       // x + s u
    Planes force_;       // divided by mass
    Planes b_, change_;  // -G, Δu
};

template <class Real>
std::unique_ptr<Method<Real>> makeSdirk2(const MethodOptions& options) {
    return std::make_unique<Sdirk2<Real>>(options);
}

}  // namespace

MethodInfo sdirk2() {
    return {.name = "sdirk2",
            .title = sdirk2Title,
            .order = 2,
            .evaluations = 2,
            .storedArrays = 13,
            .symplectic = false,
            .reversible = false,
            .limit = "none on linear problems; two solves a step; fast modes are damped",
            .caution = "",
            .largestStep = unlimitedStep,
            .automaticStep = unlimitedStep,
            .make = {makeSdirk2<float>, makeSdirk2<double>}};
}

}  // namespace taut::ode
