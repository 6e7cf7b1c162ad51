#include "taut/collision/private/cull.h"

#include "taut/core/private/vectors.h"

namespace taut::collision {

namespace {

using core::TAUT_ISA::larger;
using core::TAUT_ISA::load;
using core::TAUT_ISA::smaller;

template <class Real>
void rowBounds(const Real* a, const Real* b, int count, double& low, double& high) {
    using Vector = core::TAUT_ISA::NarrowVector<Real>;
    constexpr int width = static_cast<int>(sizeof(Vector) / sizeof(Real));
    constexpr Real infinite = std::numeric_limits<Real>::infinity();
    Vector least{};
    least += infinite;
    Vector most = -least;
    int i = 0;
    for (; i + width <= count; i += width) {
        const Vector va = load<Vector>(a + i), vb = load<Vector>(b + i);
        least = smaller(vb, smaller(va, least));
        most = larger(vb, larger(va, most));
    }
    Real l = infinite;
    Real m = -infinite;
    for (; i < count; ++i) {
        l = smaller(b[i], smaller(a[i], l));
        m = larger(b[i], larger(a[i], m));
    }
    for (int k = 0; k < width; ++k) {
        l = smaller(least[k], l);
        m = larger(most[k], m);
    }
    low = l;
    high = m;
}

}  // namespace

template <class Real>
core::Aabb boundsOf(const BlockRows<Real>& rows) {
    core::Aabb box;
    for (int k = 0; k < 3; ++k) rowBounds(rows.before[k], rows.after[k], rows.count, box.low[k], box.high[k]);
    return box;
}

template <class Real>
void markNearBox(const BlockRows<Real>& rows, const core::Aabb& box, std::uint32_t bit, std::uint32_t* mask) {
    for (int k = 0; k < 3; ++k) {
        const Real* const a = rows.before[k];
        const Real* const b = rows.after[k];
        const Real low = static_cast<Real>(box.low[k]);
        const Real high = static_cast<Real>(box.high[k]);
        // One axis after the other: the first sets the bit, the others take it away.
        if (k == 0) {
            for (int i = 0; i < rows.count; ++i) {
                const bool near = ((a[i] <= high) | (b[i] <= high)) & ((a[i] >= low) | (b[i] >= low));
                mask[i] |= near ? bit : 0U;
            }
        } else {
            for (int i = 0; i < rows.count; ++i) {
                const bool near = ((a[i] <= high) | (b[i] <= high)) & ((a[i] >= low) | (b[i] >= low));
                mask[i] &= near ? ~0U : ~bit;
            }
        }
    }
}

template <class Real>
void markUnderPlane(const BlockRows<Real>& rows, const dvec3& normal, double offset, double height, std::uint32_t bit,
                    std::uint32_t* mask) {
    const Real* const x = rows.after[0];
    const Real* const y = rows.after[1];
    const Real* const z = rows.after[2];
    const Real nx = static_cast<Real>(normal.x);
    const Real ny = static_cast<Real>(normal.y);
    const Real nz = static_cast<Real>(normal.z);
    const Real limit = static_cast<Real>(offset + height);
    for (int i = 0; i < rows.count; ++i) mask[i] |= nx * x[i] + ny * y[i] + nz * z[i] < limit ? bit : 0U;
}

template core::Aabb boundsOf(const BlockRows<float>&);
template core::Aabb boundsOf(const BlockRows<double>&);
template void markNearBox(const BlockRows<float>&, const core::Aabb&, std::uint32_t, std::uint32_t*);
template void markNearBox(const BlockRows<double>&, const core::Aabb&, std::uint32_t, std::uint32_t*);
template void markUnderPlane(const BlockRows<float>&, const dvec3&, double, double, std::uint32_t, std::uint32_t*);
template void markUnderPlane(const BlockRows<double>&, const dvec3&, double, double, std::uint32_t, std::uint32_t*);

}  // namespace taut::collision
