// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
#include "taut/mechanics/product_kernel.h"

#include "taut/core/private/vectorise.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

constexpr int productSlice = 128;  // springs at once; their ends a and b do not overlap, unless the offset is shorter

template <class Real, bool apart>
inline void addSlice(const ProductRun<Real>& s, int first, int n) {
    const long stride = s.stride, offset = s.offset;
    const Real *xa = s.u + first, *ya = xa + stride, *za = ya + stride;
    const Real *xb = xa + offset, *yb = ya + offset, *zb = za + offset;
    Real *oxa = s.out + first, *oya = oxa + stride, *oza = oya + stride;
    Real *oxb = oxa + offset, *oyb = oya + offset, *ozb = oza + offset;
    const Real *qx = s.q[0] + first, *qy = s.q[1] + first, *qz = s.q[2] + first, *beta = s.beta + first;
    alignas(64) Real gx[productSlice], gy[productSlice], gz[productSlice];
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Real dx = xb[i] - xa[i], dy = yb[i] - ya[i], dz = zb[i] - za[i];
        const Real along = qx[i] * dx + qy[i] * dy + qz[i] * dz;
        const Real px = beta[i] * dx + along * qx[i], py = beta[i] * dy + along * qy[i],
                   pz = beta[i] * dz + along * qz[i];
        oxa[i] -= px;
        oya[i] -= py;
        oza[i] -= pz;
        if (apart) {
            oxb[i] += px;
            oyb[i] += py;
            ozb[i] += pz;
        } else {
            gx[i] = px;
            gy[i] = py;
            gz[i] = pz;
        }
    }
    if (apart) return;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        oxb[i] += gx[i];
        oyb[i] += gy[i];
        ozb[i] += gz[i];
    }
}

}  // namespace

template <class Real>
void addProducts(const ProductRun<Real>& s) {
    for (int first = 0; first < s.n; first += productSlice) {
        const int n = s.n - first < productSlice ? s.n - first : productSlice;
        if (s.offset >= n)
            addSlice<Real, true>(s, first, n);
        else
            addSlice<Real, false>(s, first, n);
    }
}
template void addProducts(const ProductRun<float>&);
template void addProducts(const ProductRun<double>&);

}  // namespace taut::mechanics::TAUT_ISA
