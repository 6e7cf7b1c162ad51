// Conjugate gradients for A x = b with a diagonal preconditioner. It knows A only by its products. Sums are in double,
// in the same order on any processor and for any number of threads.
#pragma once

#include <functional>

#include "taut/core/aligned_array.h"

namespace taut::ode {

struct Solution {
    int products = 0;        // number of products with A
    bool converged = false;  // the preconditioned residual fell below tolerance times that of x = 0
};

template <class Real>
class ConjugateGradient {
  public:
    using Product = std::function<void(const Real* u, Real* out)>;  // out = A u

    explicit ConjugateGradient(std::size_t size) : size_(size), r_(size), p_(size), q_(size) {}

    // b and x (size); `inverse` (size) holds 1/A_ii, or 0 where x stays as given. The other equations see the given x.
    // The other x are the first guess. Expects A to be symmetric and positive definite.
    Solution solve(const Product& multiply, const Real* inverse, const Real* b, double tolerance, int maxIterations,
                   Real* x);

  private:
    double residual(const Product& multiply, const Real* inverse, const Real* b, const Real* x);

    std::size_t size_;
    core::AlignedArray<Real> r_, p_, q_;
};

// Σ w a b over `size` numbers each, in double. The order depends only on the size.
template <class Real>
double weightedSum(std::size_t size, const Real* w, const Real* a, const Real* b);

extern template class ConjugateGradient<float>;
extern template class ConjugateGradient<double>;

}  // namespace taut::ode
