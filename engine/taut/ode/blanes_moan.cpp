// Blanes and Moan's symplectic method S6 (2002): order 4 with six force evaluations a step. Its errors are so small
// that no method of this order costs less.
//
//   v += a_i h K_i,  i = 0 … 6, and in between  x += b_i h v,   K_i = a(t + c_i h, x, w_i),  a_i = a_{6-i}
//
// The last K is the first of the next step. Forces that depend on the velocity, such as drag, see
//
//   w_i = v_n + h Σ_{j<i} α_ij K_j,  w_0 = v_n
//
// No symmetric or exact flow would need these w_i. The α make the whole a Nyström method for x'' = a(t, x, v), and
// fulfil its conditions of order 4 (Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, II.14). For
// w_6 order 3 is enough, because the error of a K counts h times. The α that the conditions leave free give the widest
// range of stability with damping. Without such forces the method is symplectic and reversible.
#include <algorithm>
#include <array>
#include <cmath>

#include "taut/core/private/vectorise.h"
#include "taut/ode/method.h"
#include "taut/ode/private/implicit_solve.h"
#include "taut/ode/private/step_limits.h"

namespace taut::ode {
namespace {

constexpr int kicks = 7;

struct Coefficients {
    double kick[kicks];          // a_i
    double drift[kicks - 1];     // b_i
    double time[kicks];          // c_i = b_0 + … + b_{i-1}
    double ahead[kicks][kicks];  // α_ij
};

// Blanes and Moan 2002, table 2, S6: a_i and b_i. Those not listed follow from symmetry and from their sums, which are
// 1.
constexpr Coefficients coefficients() {
    constexpr double a[] = {0.0792036964311957, 0.353172906049774, -0.0420650803577195};
    constexpr double b[] = {0.209515106613362, -0.143851773179818};
    Coefficients c{{a[0], a[1], a[2], 1 - 2 * (a[0] + a[1] + a[2]), a[2], a[1], a[0]},
                   {b[0], b[1], 0.5 - (b[0] + b[1]), 0.5 - (b[0] + b[1]), b[1], b[0]},
                   {0, b[0], b[0] + b[1], 0.5, 1 - (b[0] + b[1]), 1 - b[0], 1},
                   {}};
    constexpr double ahead[] = {
        0.20951510661336201,  0.23131682204739024,  -0.16565348861384621,  -0.14587399670447479, 0.95157426747725615,
        -0.30570027077278117, -0.31771842757823515, 0.63463296601730812,   0.042588472520275401, 0.57483365560710764,
        0.054124479276787832, 0.32691227226771874,  0.021651685160660704,  0.31673254767636599,  0.071063909005104633,
        0.15600894280651995,  0.21569169821089576,  -0.037318538287625304, 0.21357181549662352,  -0.047699905789935833,
        0.49974598756352195};
    for (int i = 1, next = 0; i < kicks; ++i)
        for (int j = 0; j < i; ++j) c.ahead[i][j] = ahead[next++];
    return c;
}
constexpr Coefficients s6 = coefficients();

template <class Real>
class BlanesMoan final : public Method<Real> {
  public:
    enum Memory { slope, stale, count };  // K_0; one number, 1 if K_0 is not that of the state, else 0

    void start(SecondOrderSystem<Real>& system, double t, double, State<Real>& state) override {
        state.memory.assign(count, core::AlignedArray<Real>(state.layout.size()));
        state.memory[stale] = core::AlignedArray<Real>(1);
        system.prescribe(t, state.x.data(), state.v.data());
        evaluate(system, t, state.x.data(), state.v.data(), state.memory[slope].data());
    }

    void step(SecondOrderSystem<Real>& system, double t, double h, State<Real>& state) override {
        const std::size_t n = state.layout.size();
        if (seen_.size() != n) prepare(n);
        Real *x = state.x.data(), *v = state.v.data();
        if (state.memory[stale][0] != Real(0)) evaluate(system, t, x, v, state.memory[slope].data());
        state.memory[stale][0] = Real(0);
        std::copy_n(v, n, start_.data());
        std::copy_n(state.memory[slope].data(), n, slopes_[0].data());
        for (int i = 0; i < kicks; ++i) {
            if (i > 0) {
                const double at = t + s6.time[i] * h;
                predict(i, h, n);
                system.prescribe(at, x, seen_.data());
                evaluate(system, at, x, seen_.data(), slopes_[i].data());
            }
            add(n, s6.kick[i] * h, slopes_[i].data(), v);
            if (i + 1 < kicks) add(n, s6.drift[i] * h, v, x);
        }
        std::copy_n(slopes_.back().data(), n, state.memory[slope].data());
        system.prescribe(t + h, x, v);
    }

    void synchronise(SecondOrderSystem<Real>&, double, double, const State<Real>& state, Real* v) override {
        std::copy(state.v.begin(), state.v.end(), v);
    }

    void touch(State<Real>& state, std::span<const int> points) override {
        if (!points.empty()) state.memory[stale][0] = Real(1);
    }

  private:
    void prepare(std::size_t n) {
        seen_ = start_ = core::AlignedArray<Real>(n);
        slopes_.fill(seen_);
    }

    // a - γ v, with γ the drag.
    void evaluate(SecondOrderSystem<Real>& system, double t, const Real* x, const Real* v, Real* out) {
        ++this->work_.evaluations;
        const Layout layout = system.layout();
        StoreAccelerations<Real> store(layout, out);
        system.accelerate(t, x, v, store);
        const Real* drag = system.dragRates();
        for (int p = 0; p < layout.planes; ++p) {
            const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(p) * layout.stride;
            TAUT_INDEPENDENT
            for (int i = 0; i < layout.count; ++i) out[plane + i] -= drag[i] * v[plane + i];
        }
    }

    // Computes w_i -> seen_.
    void predict(int i, double h, std::size_t n) {
        std::copy_n(start_.data(), n, seen_.data());
        for (int j = 0; j < i; ++j) add(n, s6.ahead[i][j] * h, slopes_[j].data(), seen_.data());
    }

    // to += h from
    static void add(std::size_t n, double h, const Real* from, Real* to) {
        const Real step = static_cast<Real>(h);
        TAUT_INDEPENDENT
        for (std::size_t i = 0; i < n; ++i) to[i] += step * from[i];
    }

    core::AlignedArray<Real> start_, seen_;               // v_n, w_i
    std::array<core::AlignedArray<Real>, kicks> slopes_;  // K_i
};

template <class Real>
std::unique_ptr<Method<Real>> makeBlanesMoan(const MethodOptions&) {
    return std::make_unique<BlanesMoan<Real>>();
}

// The matrix of one step of x'' = -ω² x - c v, with h = 1, ω = z, c = d. It acts on x, v/r and K/r², r the larger of z
// and d.
using Matrix = std::array<std::array<double, 3>, 3>;

Matrix stepMatrix(double z, double d) {
    const double r = std::max(z, d);
    Matrix m{};
    for (std::size_t column = 0; column < 3; ++column) {
        double x = column == 0 ? 1 : 0, v = column == 1 ? r : 0, slopes[kicks] = {column == 2 ? r * r : 0};
        const double start = v;
        for (int i = 0; i < kicks; ++i) {
            double seen = start;
            for (int j = 0; j < i; ++j) seen += s6.ahead[i][j] * slopes[j];
            if (i > 0) slopes[i] = -z * z * x - d * seen;
            v += s6.kick[i] * slopes[i];
            if (i + 1 < kicks) x += s6.drift[i] * v;
        }
        m[0][column] = x;
        m[1][column] = v / r;
        m[2][column] = slopes[kicks - 1] / (r * r);
    }
    return m;
}

// Whether no eigenvalue of the step lies outside the unit circle, by Jury's conditions on λ³ + p λ² + q λ + s. Undamped
// motion meets some conditions with equality, so they allow for rounding.
bool isStable(double z, double d) {
    constexpr double rounding = 1e-11;
    const Matrix m = stepMatrix(z, d);
    const auto minor = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
        return m[i][k] * m[j][l] - m[i][l] * m[j][k];
    };
    const double p = -(m[0][0] + m[1][1] + m[2][2]), q = minor(0, 1, 0, 1) + minor(0, 2, 0, 2) + minor(1, 2, 1, 2);
    const double s = -(m[0][0] * minor(1, 2, 1, 2) - m[0][1] * minor(1, 2, 0, 2) + m[0][2] * minor(1, 2, 0, 1));
    return 1 + p + q + s > -rounding && 1 - p + q - s > -rounding && std::abs(q - s * p) < 1 - s * s + rounding &&
           s * s < 1 + rounding;
}

// z = ω h at which undamped motion first grows, by 1.4 % a step at most. From 3.160 to 6.314 it does not grow. With
// ζ > 0.0044 no motion grows up to 6.3 and more.
constexpr double undampedLimit = 3.132823398;
constexpr double dashpotLimit = 9.5760540;  // largest stable h times a rate that no spring opposes

// The first z at which a mode of this damping ratio grows.
double firstUnstable(double zeta) {
    constexpr double narrow = 0.01,
                     most = 8.5;  // narrower than the ranges in which a mode grows; none is stable beyond
    double z = std::min(1.0, 1 / (zeta + 1));
    while (z < most && isStable(z + narrow, 2 * zeta * (z + narrow))) z += narrow;
    return bisect(z, z + narrow, [&](double at) { return isStable(at, 2 * zeta * at); });
}

double blanesMoanLargestStep(const FastestMode& mode) {
    return explicitLimit(mode, dashpotLimit, firstUnstable);
}

// The step with damping is never longer than without: slower modes may have less damping, and may lie in the range
// where undamped motion grows.
double blanesMoanAutomaticStep(const FastestMode& mode) {
    return explicitLimit(
        mode, dashpotLimit,
        [](double zeta) {
            constexpr double leastLimiting = 1.19;
            if (zeta < leastLimiting) return undampedLimit;
            return bisect(
                0.0, undampedLimit, [&](double z) { return isStable(z, 2 * zeta * z); });
        });
}

}  // namespace

MethodInfo blanesMoan() {
    return {.name = "blanes-moan",
            .title = "Blanes-Moan S6",
            .order = 4,
            .evaluations = 6,
            .storedArrays = 10,
            .symplectic = true,
            .reversible = true,
            .limit = "3.133 at ζ = 0, 6.3 and more up to ζ = 0.2; falls to 9.58/2ζ; auto keeps to 3.133",
            .caution = "",
            .largestStep = blanesMoanLargestStep,
            .automaticStep = blanesMoanAutomaticStep,
            .make = {makeBlanesMoan<float>, makeBlanesMoan<double>}};
}

}  // namespace taut::ode
