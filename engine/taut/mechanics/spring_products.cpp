#include "taut/mechanics/spring_products.h"

#include <algorithm>
#include <cmath>

#include "taut/core/private/instruction_set.h"

namespace taut::mechanics {

TAUT_KERNELS(template <class Real> void addProducts(const ProductRun<Real>&);)

namespace {

template <class Real>
std::size_t springsIn(const SpringNetwork<Real>& network) {
    std::size_t springs = static_cast<std::size_t>(network.singles.size());
    for (const SpringRun<Real>& run : network.runs) springs += static_cast<std::size_t>(run.count);
    return springs;
}

}  // namespace

template <class Real>
SpringProducts<Real>::SpringProducts() : addRun_(TAUT_IN_USE(addProducts<Real>)) {}

template <class Real>
void SpringProducts<Real>::lineariseOne(std::size_t at, const Real* xa, const Real* xb, int stride, Real k, Real rest,
                                        Real along, Real across) {
    const Real dx = xb[0] - xa[0], dy = xb[stride] - xa[stride], dz = xb[2 * stride] - xa[2 * stride];
    const Real l = std::sqrt(dx * dx + dy * dy + dz * dz);
    const Real inverse = l > Real(0) ? Real(1) / l : Real(0);
    const Real tension = l > Real(0) || rest == Real(0) ? std::max(Real(0), Real(1) - rest * inverse) : Real(0);
    beta_[at] = across * k * tension;
    const Real q = std::sqrt(std::max(Real(0), along * k - beta_[at])) * inverse;
    q_[0][at] = q * dx;
    q_[1][at] = q * dy;
    q_[2][at] = q * dz;
}

template <class Real>
void SpringProducts<Real>::linearise(const SpringNetwork<Real>& network, int stride, const Real* x, double stiffness,
                                     double damping) {
    if (const std::size_t springs = springsIn(network); beta_.size() != springs)
        q_[0] = q_[1] = q_[2] = beta_ = core::AlignedArray<Real>(springs);
    const auto along = [&](Real tau) { return static_cast<Real>(stiffness + damping * static_cast<double>(tau)); };
    const Real across = static_cast<Real>(stiffness);
    std::size_t at = 0;
    for (const SpringRun<Real>& run : network.runs) {
        const Real* k = network.stiffness.data() + run.table;
        const Real alongRun = along(run.tau);
        const Real* lengths = run.mixed < 0 ? nullptr : network.mixed.data() + run.mixed;
        for (int i = 0; i < run.count; ++i, ++at)
            lineariseOne(at, x + run.a + i, x + run.a + i + run.offset, stride, k[i],
                         lengths != nullptr ? lengths[i] : run.restLength,
                         lengths != nullptr ? along(lengths[run.count + i]) : alongRun, across);
    }
    const SpringSingles<Real>& s = network.singles;
    for (std::size_t i = 0; i < s.a.size(); ++i, ++at)
        lineariseOne(at, x + s.a[i], x + s.b[i], stride, s.k[i], s.restLength[i], along(s.tau[i]), across);
}

template <class Real>
void SpringProducts<Real>::addProduct(const SpringNetwork<Real>& network, int stride, const Real* u, Real* out) const {
    std::size_t at = 0;
    for (const SpringRun<Real>& run : network.runs) {
        addRun_({run.count,
                 run.offset,
                 stride,
                 {q_[0].data() + at, q_[1].data() + at, q_[2].data() + at},
                 beta_.data() + at,
                 u + run.a,
                 out + run.a});
        at += static_cast<std::size_t>(run.count);
    }
    const SpringSingles<Real>& s = network.singles;
    for (std::size_t i = 0; i < s.a.size(); ++i, ++at) {
        const Real *ua = u + s.a[i], *ub = u + s.b[i];
        Real d[3], along = 0;
        for (int p = 0; p < 3; ++p) {
            d[p] = ub[p * stride] - ua[p * stride];
            along += q_[p][at] * d[p];
        }
        for (int p = 0; p < 3; ++p) {
            const Real product = beta_[at] * d[p] + along * q_[p][at];
            out[p * stride + s.a[i]] -= product;
            out[p * stride + s.b[i]] += product;
        }
    }
}

template <class Real>
void SpringProducts<Real>::addDiagonal(const SpringNetwork<Real>& network, int stride, Real* out) const {
    std::size_t at = 0;
    const auto add = [&](int a, int b) {
        for (int p = 0; p < 3; ++p) {
            const Real entry = beta_[at] + q_[p][at] * q_[p][at];
            out[p * stride + a] += entry;
            out[p * stride + b] += entry;
        }
        ++at;
    };
    for (const SpringRun<Real>& run : network.runs)
        for (int i = 0; i < run.count; ++i) add(run.a + i, run.a + i + run.offset);
    for (std::size_t i = 0; i < network.singles.a.size(); ++i) add(network.singles.a[i], network.singles.b[i]);
}

template class SpringProducts<float>;
template class SpringProducts<double>;

}  // namespace taut::mechanics
