#include "taut/ode/private/runge_kutta.h"

#include <algorithm>

#include "taut/core/aligned_array.h"
#include "taut/core/private/vectorise.h"

namespace taut::ode {
namespace {

template <class Real>
class RungeKutta final : public FirstOrderMethod<Real> {
  public:
    explicit RungeKutta(const Tableau& tableau) : tableau_(tableau) {
        for (int s = 0; s + 1 < tableau.stages; ++s) usesSum_ = usesSum_ || tableau.w[s] != 0;
    }

    void step(System<Real>& system, double t, double h, Real* y) override {
        const std::size_t n = system.size();
        if (slope_.size() != n) prepare(n);
        for (int s = 0; s < tableau_.stages; ++s) {
            const double at = t + tableau_.c[s] * h;
            if (s == 0) {
                system.derivative(at, y, slope_.data());
            } else {
                advance(n, y, static_cast<Real>(tableau_.c[s] * h), slope_.data(), stage_.data());
                system.prescribe(at, stage_.data());
                system.derivative(at, stage_.data(), slope_.data());
            }
            if (usesSum_) addSlope(n, s);
        }
        advance(n, y, static_cast<Real>(h / tableau_.divisor), usesSum_ ? sum_.data() : slope_.data(), y);
        system.prescribe(t + h, y);
    }

    int evaluations() const override { return tableau_.stages; }

  private:
    void prepare(std::size_t n) {
        slope_ = core::AlignedArray<Real>(n);
        if (tableau_.stages > 1) stage_ = slope_;
        if (usesSum_) sum_ = slope_;
    }

    // to = y + h slope; `to` may be y.
    static void advance(std::size_t n, const Real* y, Real h, const Real* slope, Real* to) {
        TAUT_INDEPENDENT
        for (std::size_t i = 0; i < n; ++i) to[i] = y[i] + h * slope[i];
    }

    void addSlope(std::size_t n, int stage) {
        const Real weight = static_cast<Real>(tableau_.w[stage]);
        const Real* slope = slope_.data();
        Real* sum = sum_.data();
        if (stage == 0) std::fill_n(sum, n, Real(0));
        TAUT_INDEPENDENT
        for (std::size_t i = 0; i < n; ++i) sum[i] += weight * slope[i];
    }

    Tableau tableau_;
    bool usesSum_ = false;  // false: only the last slope counts, and its weight is the divisor
    core::AlignedArray<Real> slope_, stage_, sum_;
};

}  // namespace

template <class Real>
std::unique_ptr<FirstOrderMethod<Real>> makeRungeKutta(const Tableau& tableau) {
    return std::make_unique<RungeKutta<Real>>(tableau);
}
template std::unique_ptr<FirstOrderMethod<float>> makeRungeKutta(const Tableau&);
template std::unique_ptr<FirstOrderMethod<double>> makeRungeKutta(const Tableau&);

}  // namespace taut::ode
