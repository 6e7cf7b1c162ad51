#include "taut/ode/private/conjugate_gradient.h"

#include "taut/core/private/vectorise.h"

namespace taut::ode {
namespace {

constexpr std::size_t lanes = 8;  // sums side by side, so that the loops vectorise

double total(const double (&sum)[lanes]) {
    return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

template <class Real>
double dot(std::size_t size, const Real* a, const Real* b) {
    double sum[lanes] = {};
    const std::size_t whole = size - size % lanes;
    for (std::size_t i = 0; i < whole; i += lanes)
        for (std::size_t j = 0; j < lanes; ++j) sum[j] += static_cast<double>(a[i + j]) * static_cast<double>(b[i + j]);
    for (std::size_t i = whole; i < size; ++i) sum[0] += static_cast<double>(a[i]) * static_cast<double>(b[i]);
    return total(sum);
}

}  // namespace

template <class Real>
double weightedSum(std::size_t size, const Real* w, const Real* a, const Real* b) {
    double sum[lanes] = {};
    const auto term = [&](std::size_t i) {
        return static_cast<double>(w[i]) * (static_cast<double>(a[i]) * static_cast<double>(b[i]));
    };
    const std::size_t whole = size - size % lanes;
    for (std::size_t i = 0; i < whole; i += lanes)
        for (std::size_t j = 0; j < lanes; ++j) sum[j] += term(i + j);
    for (std::size_t i = whole; i < size; ++i) sum[0] += term(i);
    return total(sum);
}

// Computes r = b - A x. Returns its squared norm.
template <class Real>
double ConjugateGradient<Real>::residual(const Product& multiply, const Real* inverse, const Real* b, const Real* x) {
    multiply(x, q_.data());
    for (std::size_t i = 0; i < size_; ++i) r_[i] = b[i] - q_[i];
    return weightedSum(size_, inverse, r_.data(), r_.data());
}

template <class Real>
Solution ConjugateGradient<Real>::solve(const Product& multiply, const Real* inverse, const Real* b, double tolerance,
                                        int maxIterations, Real* x) {
    Solution solution;
    // The tolerance is relative to the right-hand side as the free unknowns see it: given x move to that side.
    double scale = weightedSum(size_, inverse, b, b);
    bool isGiven = false;
    for (std::size_t i = 0; i < size_; ++i) isGiven = isGiven || (inverse[i] == Real(0) && x[i] != Real(0));
    if (isGiven) {
        for (std::size_t i = 0; i < size_; ++i) p_[i] = inverse[i] == Real(0) ? x[i] : Real(0);
        scale = residual(multiply, inverse, b, p_.data());
        ++solution.products;
    }
    if (scale == 0.0) {
        for (std::size_t i = 0; i < size_; ++i) x[i] = inverse[i] == Real(0) ? x[i] : Real(0);
        solution.converged = true;
        return solution;
    }
    const double target = tolerance * tolerance * scale;

    // The iterations, from the given x on.
    double rho = residual(multiply, inverse, b, x);
    ++solution.products;
    for (std::size_t i = 0; i < size_; ++i) p_[i] = inverse[i] * r_[i];
    for (int iteration = 0; iteration < maxIterations && !(rho <= target); ++iteration) {
        multiply(p_.data(), q_.data());
        ++solution.products;
        const double curvature = dot(size_, p_.data(), q_.data());
        if (!(curvature > 0.0)) break;  // it is not a number, or nothing but rounding is left
        const Real along = static_cast<Real>(rho / curvature);
        Real *r = r_.data(), *p = p_.data();
        const Real* q = q_.data();
        TAUT_INDEPENDENT
        for (std::size_t i = 0; i < size_; ++i) {
            x[i] += along * p[i];
            r[i] -= along * q[i];
        }
        const double next = weightedSum(size_, inverse, r, r);
        const Real keep = static_cast<Real>(next / rho);
        rho = next;
        TAUT_INDEPENDENT
        for (std::size_t i = 0; i < size_; ++i) p[i] = inverse[i] * r[i] + keep * p[i];
    }
    solution.converged = rho <= target;
    return solution;
}

template class ConjugateGradient<float>;
template class ConjugateGradient<double>;
template double weightedSum(std::size_t, const float*, const float*, const float*);
template double weightedSum(std::size_t, const double*, const double*, const double*);

}  // namespace taut::ode
