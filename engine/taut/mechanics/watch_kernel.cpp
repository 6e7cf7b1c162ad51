// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
#include "taut/mechanics/private/watch_kernel.h"

#include <cstdint>

#include "taut/core/private/vectorise.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

// A mask type as wide as the compared numbers, so that masks need no narrowing.
template <class Real>
struct MaskOf;
template <>
struct MaskOf<float> {
    using Type = int;
};
template <>
struct MaskOf<double> {
    using Type = std::int64_t;
};

}  // namespace

template <class Real>
bool isAnyBeyond(const WatchRun<Real>& s) {
    using Mask = typename MaskOf<Real>::Type;
    const Real *ax = s.x, *ay = ax + s.stride, *az = ay + s.stride;
    const Real *bx = ax + s.offset, *by = ay + s.offset, *bz = az + s.offset, *least = s.least, *most = s.most;
    Mask beyond = 0;
    if (least == nullptr) {
        TAUT_INDEPENDENT
        for (int i = 0; i < s.n; ++i) {
            const Real dx = bx[i] - ax[i], dy = by[i] - ay[i], dz = bz[i] - az[i];
            beyond |= dx * dx + dy * dy + dz * dz > most[i] ? Mask(1) : Mask(0);
        }
        return beyond != 0;
    }
    TAUT_INDEPENDENT
    for (int i = 0; i < s.n; ++i) {
        const Real dx = bx[i] - ax[i], dy = by[i] - ay[i], dz = bz[i] - az[i];
        const Real square = dx * dx + dy * dy + dz * dz;
        beyond |= (square > most[i] ? Mask(1) : Mask(0)) | (square < least[i] ? Mask(1) : Mask(0));
    }
    return beyond != 0;
}
template bool isAnyBeyond(const WatchRun<float>&);
template bool isAnyBeyond(const WatchRun<double>&);

template <class Real>
bool isAnyInListBeyond(const WatchList<Real>& s) {
    bool beyond = false;
    for (int i = 0; i < s.n; ++i) {
        const Real *a = s.x + s.a[i], *b = s.x + s.b[i];
        const Real dx = b[0] - a[0], dy = b[s.stride] - a[s.stride], dz = b[2L * s.stride] - a[2L * s.stride];
        const Real square = dx * dx + dy * dy + dz * dz;
        beyond |= square > s.most[i];
        if (s.least != nullptr) beyond |= square < s.least[i];
    }
    return beyond;
}
template bool isAnyInListBeyond(const WatchList<float>&);
template bool isAnyInListBeyond(const WatchList<double>&);

}  // namespace taut::mechanics::TAUT_ISA
