// Shared by implicit methods: linear systems of the masses and the derivatives of the forces, and loops over planes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "taut/core/error.h"
#include "taut/ode/method.h"
#include "taut/ode/private/conjugate_gradient.h"
#include "taut/ode/private/supports.h"

namespace taut::ode {

// Calls f(index in the array, point) for all numbers in use, plane by plane.
template <class F>
void forEachNumber(Layout layout, F&& f) {
    for (int p = 0; p < layout.planes; ++p)
        for (int i = 0; i < layout.count; ++i)
            f(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) * layout.stride + i),
              static_cast<std::size_t>(i));
}

// [s] The largest step of methods that are stable on linear problems for every step.
inline double unlimitedStep(const FastestMode&) {
    return HUGE_VAL;
}

// Stores the accelerations in out (layout.size()).
template <class Real>
class StoreAccelerations final : public AccelerationSink<Real> {
  public:
    StoreAccelerations(Layout layout, Real* out) : layout_(layout), out_(out) {}
    void take(int first, int last, const Real* const* a) override {
        for (int p = 0; p < layout_.planes; ++p)
            std::copy_n(a[p], last - first, out_ + static_cast<std::ptrdiff_t>(p) * layout_.stride + first);
    }

  private:
    Layout layout_;
    Real* out_;
};

// Throws core::Error(usage) if the system gives no derivatives. `title` names the method that needs them.
template <class Real>
ImplicitSystem<Real>& implicitPartOf(SecondOrderSystem<Real>& system, std::string_view title) {
    if (ImplicitSystem<Real>* implicit = system.implicitPart()) return *implicit;
    throw core::Error(core::ErrorKind::usage,
                      std::string(title) + " needs a system that gives masses and the derivatives of its forces");
}

// A = M + sΓ + sC + s²K at a configuration, Γ the drag m γ. Its solves stop at a tolerance that the precision can
// reach.
template <class Real>
class ImplicitMatrix {
  public:
    static constexpr double finest = sizeof(Real) < sizeof(double) ? 1e-6 : 1e-14;

    explicit ImplicitMatrix(const MethodOptions& options)
        : tolerance_(std::max(options.tolerance, finest)), maxIterations_(options.maxIterations), solver_(0) {
        TAUT_EXPECTS(options.newtonSteps >= 1 && options.tolerance > 0.0 && options.maxIterations >= 1);
    }

    void resize(std::size_t size) {
        inverse_ = core::AlignedArray<Real>(size);
        solver_ = ConjugateGradient<Real>(size);
    }
    std::size_t size() const { return inverse_.size(); }

    // Fixes A at (t, x, v); s [s].
    void fix(SecondOrderSystem<Real>& system, double t, const Real* x, const Real* v, double s,
             const Supports<Real>* supports = nullptr) {
        system_ = &system;
        implicit_ = system.implicitPart();
        step_ = static_cast<Real>(s);
        implicit_->linearise(t, x, v, s * s, s);
        std::fill(inverse_.begin(), inverse_.end(), Real(0));
        implicit_->addDiagonal(inverse_.data());
        const Real *mass = implicit_->masses(), *inverseMass = implicit_->inverseMasses(), *drag = system.dragRates();
        forEachNumber(system.layout(), [&](std::size_t at, std::size_t i) {
            const Real own = mass[i] * (Real(1) + step_ * drag[i]);
            const bool isFree = inverseMass[i] > Real(0) && (supports == nullptr || supports->isFree(i));
            inverse_[at] = isFree ? Real(1) / (inverse_[at] + own) : Real(0);
        });
        if (supports != nullptr) supports->level(inverse_.data());
    }

    // Solves A u = b from the guess u. Points that are held or moved by hand keep their given u.
    Solution solve(const Real* b, Real* u, Work& work) {
        return solve([this](const Real* in, Real* out) { multiply(in, out); }, b, u, work);
    }

    // The same with points that contacts hold up. Their u along the normal is given too, and the solve finds their u
    // across it. Adds to the impulse of each support. Overwrites b.
    Solution solve(core::AlignedArray<Real>& b, core::AlignedArray<Real>& u, const Supports<Real>& supports,
                   Work& work) {
        if (supports.empty()) return solve(b.data(), u.data(), work);
        const auto multiplyAcross = [&](const Real* in, Real* out) {
            multiply(in, out);
            supports.flatten(out);
        };
        // The given part along the normals goes to the other side of the equation.
        if (given_.size() != u.size()) given_ = product_ = whole_ = core::AlignedArray<Real>(u.size());
        std::copy(u.begin(), u.end(), given_.begin());
        supports.flatten(u.data());
        for (std::size_t i = 0; i < u.size(); ++i) given_[i] -= u[i];
        multiplyAcross(given_.data(), product_.data());
        std::copy(b.begin(), b.end(), whole_.begin());
        supports.flatten(b.data());
        for (std::size_t i = 0; i < b.size(); ++i) b[i] -= product_[i];
        const Solution solution = solve(multiplyAcross, b.data(), u.data(), work);
        // The residual of the equations along the normals is the impulse of the supports.
        for (std::size_t i = 0; i < u.size(); ++i) u[i] += given_[i];
        multiply(u.data(), product_.data());
        for (Support& support : supports.all())
            support.impulse += (supports.along(support, product_.data()) - supports.along(support, whole_.data())) /
                               static_cast<double>(implicit_->masses()[Supports<Real>::index(support)]);
        return solution;
    }

  private:
    void multiply(const Real* in, Real* out) {
        const Layout layout = system_->layout();
        const Real *mass = implicit_->masses(), *drag = system_->dragRates();
        std::fill_n(out, layout.size(), Real(0));
        forEachNumber(layout,
                      [&](std::size_t at, std::size_t i) { out[at] = mass[i] * (Real(1) + step_ * drag[i]) * in[at]; });
        implicit_->addProduct(in, out);
    }
    template <class Product>
    Solution solve(const Product& product, const Real* b, Real* u, Work& work) {
        const Solution solution = solver_.solve(product, inverse_.data(), b, tolerance_, maxIterations_, u);
        work.iterations += solution.products;
        if (!solution.converged) ++work.unconverged;
        return solution;
    }

    double tolerance_;
    int maxIterations_;
    ConjugateGradient<Real> solver_;
    core::AlignedArray<Real> inverse_;                  // of the diagonal, 0 for held points
    core::AlignedArray<Real> given_, product_, whole_;  // of a solve with points held up
    SecondOrderSystem<Real>* system_ = nullptr;
    ImplicitSystem<Real>* implicit_ = nullptr;
    Real step_ = 0;
};

// The solver cannot handle a force that is not a number, and would leave the state unchanged. So the value goes into
// the unknown of its point, where the check of the state finds it. Returns whether there was any.
template <class Real>
bool passOnWhatIsNoNumber(const core::AlignedArray<Real>& b, core::AlignedArray<Real>& unknown, Work& work) {
    bool isThere = false;
    for (std::size_t i = 0; i < b.size(); ++i)
        if (!std::isfinite(b[i])) {
            unknown[i] = b[i];
            isThere = true;
        }
    if (isThere) ++work.unconverged;
    return isThere;
}

}  // namespace taut::ode
