// Compiled once for each instruction set (engine/taut.cmake). The lanes of a vector are x, y, z and nothing, and each
// row is summed in the order of its entries, so every width gives the same bits. Differences come first, so that single
// precision loses as little as possible.
#include "taut/mechanics/private/element_kernel.h"

#include "taut/core/private/vectorise.h"
#include "taut/mechanics/private/packed_points.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

using core::TAUT_ISA::root;

template <class Real>
void addCouplings(const CouplingBatch<Real>& batch) {
    const Real *x = batch.couplings.vectors, *pull = batch.pulls.vectors;
    for (int i = batch.begin; i < batch.end; ++i) {
        Four<Real> own, sum{};
        fetch(x + 4L * i, own);
        for (int k = batch.couplings.first[i]; k < batch.couplings.first[i + 1]; ++k) {
            const WeightedPoint<Real>& entry = batch.couplings.entries[k];
            Four<Real> other;
            fetch(x + 4L * entry.from, other);
            sum += entry.weight * (other - own);
        }
        for (int k = batch.pulls.first[i]; k < batch.pulls.first[i + 1]; ++k) {
            const WeightedPoint<Real>& entry = batch.pulls.entries[k];
            Four<Real> other;
            fetch(pull + 4L * entry.from, other);
            sum += entry.weight * other;
        }
        sum *= batch.scale;
        Real* to = batch.out + batch.points[i];
        to[0] += sum[0];
        to[batch.stride] += sum[1];
        to[2 * batch.stride] += sum[2];
    }
}

template <class Real>
inline void sumUp(const WeightedRows<Real>& rows, int i, Four<Real>& sum) {
    const int begin = rows.first[i], end = rows.first[i + 1];
    const Real* x = rows.vectors;
    Four<Real> from;
    sum = Four<Real>{};
    fetch(x + 4L * rows.entries[begin].from, from);
    for (int k = begin + 1; k < end; ++k) {
        const WeightedPoint<Real>& entry = rows.entries[k];
        Four<Real> other;
        fetch(x + 4L * entry.from, other);
        sum += entry.weight * (other - from);
    }
}

template <class Real>
void findSums(const SumBatch<Real>& batch) {
    for (int i = batch.begin; i < batch.end; ++i) {
        Four<Real> sum;
        sumUp(batch.rows, i, sum);
        put(batch.sums + 4L * i, sum);
    }
}

// With N = e1 × e2 the normal is n = N/|N|, and g_b·y = e2·m, g_c·y = -e1·m with m = n × y/|N|.
template <class Real>
void findPulls(const PullBatch<Real>& batch) {
    const Real* x = batch.rows.vectors;
    for (int i = batch.begin; i < batch.end; ++i) {
        Four<Real> y;
        sumUp(batch.rows, i, y);
        if (batch.held != nullptr) {
            Four<Real> held;
            fetch(batch.held + 4L * i, held);
            y += held;
        }
        const int* corners = batch.corners + 3L * i;
        Four<Real> normal = y;
        Real b = 0, c = 0;
        if (corners[0] < 0) {
            const Real length = root(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
            normal *= length > 0 ? 1 / length : Real(0);
        } else {
            const Real *from = x + 4L * corners[0], *toB = x + 4L * corners[1], *toC = x + 4L * corners[2];
            const Real ux = toB[0] - from[0], uy = toB[1] - from[1], uz = toB[2] - from[2];
            const Real vx = toC[0] - from[0], vy = toC[1] - from[1], vz = toC[2] - from[2];
            const Real nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
            const Real length = root(nx * nx + ny * ny + nz * nz);
            const Real inverse = length > 0 ? 1 / length : Real(0);
            normal = Four<Real>{nx, ny, nz, 0} * inverse;
            const Real mx = (normal[1] * y[2] - normal[2] * y[1]) * inverse,
                       my = (normal[2] * y[0] - normal[0] * y[2]) * inverse,
                       mz = (normal[0] * y[1] - normal[1] * y[0]) * inverse;
            b = -(vx * mx + vy * my + vz * mz);
            c = ux * mx + uy * my + uz * mz;
        }
        const Four<Real> all[4] = {normal, -(b + c) * normal, b * normal, c * normal};
        __builtin_memcpy(batch.pulls + 16L * i, all, sizeof all);
    }
}

}  // namespace

template <class Real>
ElementKernels<Real> elementKernels() {
    return {addCouplings<Real>, findSums<Real>, findPulls<Real>};
}
template ElementKernels<float> elementKernels();
template ElementKernels<double> elementKernels();

}  // namespace taut::mechanics::TAUT_ISA
