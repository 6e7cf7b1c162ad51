#include "taut/study/fehlberg78.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "taut/core/private/vectorise.h"
#include "taut/ode/system.h"

namespace taut::study {
namespace {

constexpr std::size_t stages = 13;

struct Fehlberg {
    std::array<double, stages> c;                      // times
    std::array<std::array<double, stages>, stages> a;  // weights of the stages before
    std::array<double, stages> b;                      // of order 8
    double e;                                          // e (k_1 + k_11 - k_12 - k_13): order 7 less order 8
};

// Fehlberg, NASA TR R-287 (1968), table X.
constexpr Fehlberg fehlberg = {
    {0, 2.0 / 27, 1.0 / 9, 1.0 / 6, 5.0 / 12, 1.0 / 2, 5.0 / 6, 1.0 / 6, 2.0 / 3, 1.0 / 3, 1, 0, 1},
    {{{},
      {2.0 / 27},
      {1.0 / 36, 1.0 / 12},
      {1.0 / 24, 0, 1.0 / 8},
      {5.0 / 12, 0, -25.0 / 16, 25.0 / 16},
      {1.0 / 20, 0, 0, 1.0 / 4, 1.0 / 5},
      {-25.0 / 108, 0, 0, 125.0 / 108, -65.0 / 27, 125.0 / 54},
      {31.0 / 300, 0, 0, 0, 61.0 / 225, -2.0 / 9, 13.0 / 900},
      {2, 0, 0, -53.0 / 6, 704.0 / 45, -107.0 / 9, 67.0 / 90, 3},
      {-91.0 / 108, 0, 0, 23.0 / 108, -976.0 / 135, 311.0 / 54, -19.0 / 60, 17.0 / 6, -1.0 / 12},
      {2383.0 / 4100, 0, 0, -341.0 / 164, 4496.0 / 1025, -301.0 / 82, 2133.0 / 4100, 45.0 / 82, 45.0 / 164, 18.0 / 41},
      {3.0 / 205, 0, 0, 0, 0, -6.0 / 41, -3.0 / 205, -3.0 / 41, 3.0 / 41, 6.0 / 41, 0},
      {-1777.0 / 4100, 0, 0, -341.0 / 164, 4496.0 / 1025, -289.0 / 82, 2193.0 / 4100, 51.0 / 82, 33.0 / 164, 12.0 / 41,
       0, 1}}},
    {0, 0, 0, 0, 0, 34.0 / 105, 9.0 / 35, 9.0 / 35, 9.0 / 280, 9.0 / 280, 0, 41.0 / 840, 41.0 / 840},
    41.0 / 840};

template <class Real>
class Controlled final : public ode::Method<Real> {
  public:
    explicit Controlled(const ode::MethodOptions& options) : tolerance_(options.tolerance) {}

    void start(ode::SecondOrderSystem<Real>& system, double t, double, ode::State<Real>& state) override {
        state.memory.assign(1, core::AlignedArray<Real>(1));  // the inner step to try; 0: none yet
        system.prescribe(t, state.x.data(), state.v.data());
    }

    void step(ode::SecondOrderSystem<Real>& system, double t, double h, ode::State<Real>& state) override {
        const std::size_t half = state.layout.size(), n = 2 * half;
        if (y_.size() != n) prepare(n);
        std::copy_n(state.x.data(), half, y_.data());
        std::copy_n(state.v.data(), half, y_.data() + half);
        ode::FirstOrderView<Real> view(system);
        double inner = static_cast<double>(state.memory[0][0]);
        if (!(inner > 0)) inner = h / 16;
        integrate(view, state.layout, t, h, inner);
        state.memory[0][0] = static_cast<Real>(inner);
        std::copy_n(y_.data(), half, state.x.data());
        std::copy_n(y_.data() + half, half, state.v.data());
    }

    void synchronise(ode::SecondOrderSystem<Real>&, double, double, const ode::State<Real>& state, Real* v) override {
        std::copy(state.v.begin(), state.v.end(), v);
    }

    void touch(ode::State<Real>&, std::span<const int>) override {}

  private:
    void prepare(std::size_t n) {
        y_ = next_ = core::AlignedArray<Real>(n);
        slopes_.fill(y_);
    }

    void integrate(ode::System<Real>& view, ode::Layout layout, double t, double h, double& inner) {
        constexpr int most = 10'000;
        double done = 0;
        for (int i = 0; done < h; ++i) {
            const bool isControlled = i < most;
            if (!isControlled) ++this->work_.unconverged;
            const bool isLast = !isControlled || done + inner * (1 + 1e-9) >= h;
            const double tried = isLast ? h - done : std::min(inner, 0.5 * (h - done));
            const double error = tryStep(view, layout, t + done, tried);
            if (!std::isfinite(error) && !(tried > 1e-9 * h)) return std::swap(y_, next_);  // seen by who looks at it
            const double ratio = error / ((tolerance_ + rounding_) * tried);  // as the length to the 7th power
            const bool isTaken = ratio <= 1 || !isControlled;
            const double factor = std::isfinite(ratio) ? 0.9 * std::pow(std::max(ratio, 1e-12), -1.0 / 7) : 0.1;
            const double better = tried * std::clamp(factor, 0.1, 4.0);
            if (!isTaken) {
                inner = better;
                continue;
            }
            std::swap(y_, next_);
            view.prescribe(t + done + tried, y_.data());
            // A last step was shorter than it might have been.
            inner = std::max(better, isLast || tried < inner ? inner : 0.0);
            done = isLast ? h : done + tried;
        }
    }

    // From y_ to next_; the RMS of the estimated error.
    double tryStep(ode::System<Real>& view, ode::Layout layout, double t, double h) {
        const std::size_t n = y_.size();
        for (std::size_t s = 0; s < stages; ++s) {
            std::copy_n(y_.data(), n, next_.data());
            for (std::size_t j = 0; j < s; ++j) add(n, h * fehlberg.a[s][j], slopes_[j].data(), next_.data());
            view.prescribe(t + fehlberg.c[s] * h, next_.data());
            view.derivative(t + fehlberg.c[s] * h, next_.data(), slopes_[s].data());
        }
        this->work_.evaluations += static_cast<std::int64_t>(stages);
        std::copy_n(y_.data(), n, next_.data());
        for (std::size_t s = 0; s < stages; ++s) add(n, h * fehlberg.b[s], slopes_[s].data(), next_.data());
        const std::size_t half = n / 2;
        double sum = 0, size = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double weight = i < half ? 1 : h;
            const double apart = weight * (static_cast<double>(slopes_[0][i]) + static_cast<double>(slopes_[10][i]) -
                                           static_cast<double>(slopes_[11][i]) - static_cast<double>(slopes_[12][i]));
            const double slope = weight * static_cast<double>(slopes_[0][i]);
            sum += apart * apart;
            size += slope * slope;
        }
        const double numbers = std::max(1, layout.planes * layout.count);
        rounding_ = 4 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * std::sqrt(size / numbers);
        return h * fehlberg.e * std::sqrt(sum / numbers);
    }

    static void add(std::size_t n, double h, const Real* from, Real* to) {
        if (h == 0) return;
        const Real step = static_cast<Real>(h);
        TAUT_INDEPENDENT
        for (std::size_t i = 0; i < n; ++i) to[i] += step * from[i];
    }

    double tolerance_, rounding_ = 0;    // [unit/s] allowed; of the slopes, which no step makes smaller
    core::AlignedArray<Real> y_, next_;  // positions, then velocities
    std::array<core::AlignedArray<Real>, stages> slopes_;
};

template <class Real>
std::unique_ptr<ode::Method<Real>> makeControlled(const ode::MethodOptions& options) {
    return std::make_unique<Controlled<Real>>(options);
}

double anyStep(const ode::FastestMode&) {
    return HUGE_VAL;
}

}  // namespace

const std::shared_ptr<const ode::Methods>& referenceMethods() {
    static const std::shared_ptr<const ode::Methods> all = [] {
        auto methods = std::make_shared<ode::Methods>(ode::builtInMethods());
        methods->add({.name = fehlberg78,
                      .title = "Fehlberg 7(8)",
                      .order = 8,
                      .evaluations = static_cast<int>(stages),
                      .storedArrays = 30,
                      .symplectic = false,
                      .reversible = false,
                      .limit = "none: it finds its own steps",
                      .caution = "",
                      .largestStep = anyStep,
                      .automaticStep = anyStep,
                      .make = {makeControlled<float>, makeControlled<double>}});
        return methods;
    }();
    return all;
}

}  // namespace taut::study
