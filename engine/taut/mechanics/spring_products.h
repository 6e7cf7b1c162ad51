// The springs of an island linearised about a configuration, for implicit methods: products with W = s K + c C. Knows
// points by number only.
//
// A spring's share of K is k [nnᵀ + max(0, 1 - L/l)(I - nnᵀ)]. This is the true one with one exception: across itself a
// compressed spring would have negative stiffness, and gets none. Its share of C is k τ nnᵀ. At l = 0 it has no
// direction; with L = 0 its K is k I.
//
// With α = s k + c k τ along the spring and β = s k max(0, 1 - L/l) across it, W = β I + q qᵀ with q = √(α - β) n.
#pragma once

#include <cstddef>
#include <cstdint>

#include "taut/core/aligned_array.h"
#include "taut/mechanics/product_kernel.h"
#include "taut/mechanics/spring_network.h"

namespace taut::mechanics {

template <class Real>
class SpringProducts {
  public:
    SpringProducts();

    // x (3 · stride) [m].
    void linearise(const SpringNetwork<Real>& network, int stride, const Real* x, double stiffness, double damping);
    // u and out as x.
    void addProduct(const SpringNetwork<Real>& network, int stride, const Real* u, Real* out) const;
    void addDiagonal(const SpringNetwork<Real>& network, int stride, Real* out) const;
    std::uint64_t bytes() const { return 4 * beta_.size() * sizeof(Real); }

  private:
    void lineariseOne(std::size_t at, const Real* xa, const Real* xb, int stride, Real k, Real rest, Real along,
                      Real across);

    core::AlignedArray<Real> q_[3], beta_;  // (springs of the runs, gaps included, then single ones)
    void (*addRun_)(const ProductRun<Real>&);
};

extern template class SpringProducts<float>;
extern template class SpringProducts<double>;

}  // namespace taut::mechanics
