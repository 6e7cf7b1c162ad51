// What a sheaf of runs adds to the forces, summed at its slots first: each force is loaded and stored once, and not
// while its last store is still on its way to the cache. Include it in files of taut_kernel only: everything in it is
// TAUT_ISA's own.
#pragma once

#include "taut/core/vectorise.h"
#include "taut/mechanics/kernel_parts.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

// Slots no further apart are added in one go; around each slot there are as many zeros. [points]
constexpr int closeSlots = 4;

template <class Real>
struct CornerSums {
    static constexpr int line = 64 / static_cast<int>(sizeof(Real));
    static constexpr int plane = line + kernelBlock + line;
    alignas(64) Real of[mostSlots][3][plane];

    Real* at(int slot, int axis) { return of[slot][axis] + line; }
    explicit CornerSums(int slots) {
        for (int slot = 0; slot < slots; ++slot)
            for (Real* sums : of[slot]) {
                __builtin_memset(sums, 0, sizeof(Real) * line);
                __builtin_memset(sums + line + kernelBlock, 0, sizeof(Real) * line);
            }
    }
};

// One corner of a block of a run.
template <class Real>
inline void addCorner(const Real (*force)[kernelBlock], int count, int slot, bool opens, CornerSums<Real>& sums) {
    for (int axis = 0; axis < 3; ++axis) {
        const Real* from = force[axis];
        Real* to = sums.at(slot, axis);
        if (opens) {
            __builtin_memcpy(to, from, static_cast<unsigned long>(count) * sizeof(Real));
        } else {
            TAUT_INDEPENDENT
            for (int l = 0; l < count; ++l) to[l] += from[l];
        }
    }
}

template <class Real, int slots>
inline void addSlots(const Real* const* sums, int width, Real* f) {
    const Real *s0 = sums[0], *s1 = sums[1], *s2 = sums[2], *s3 = sums[3];
    TAUT_INDEPENDENT
    for (int i = 0; i < width; ++i) {
        Real sum = s0[i];
        if (slots > 1) sum += s1[i];
        if (slots > 2) sum += s2[i];
        if (slots > 3) sum += s3[i];
        f[i] += sum;
    }
}

// The sums of `count` lanes from `start` on.
template <class Real>
inline void addSums(const Sheaf& sheaf, int start, int count, CornerSums<Real>& sums, Real* f, long stride) {
    constexpr int most = 4;
    if (count < kernelBlock)
        for (int slot = 0; slot < sheaf.slotCount; ++slot)
            for (int axis = 0; axis < 3; ++axis)
                __builtin_memset(sums.at(slot, axis) + count, 0, closeSlots * sizeof(Real));
    for (int from = 0, to = 0; from < sheaf.slotCount; from = to) {
        const int first = sheaf.slots[from];
        to = from + 1;
        while (to < sheaf.slotCount && to - from < most && sheaf.slots[to] - first <= closeSlots) ++to;
        const int width = count + sheaf.slots[to - 1] - first;
        for (int axis = 0; axis < 3; ++axis) {
            const Real* of[most] = {};
            for (int slot = from; slot < to; ++slot)
                of[slot - from] = sums.at(slot, axis) - (sheaf.slots[slot] - first);
            Real* at = f + axis * stride + first + start;
            switch (to - from) {
                case 1: addSlots<Real, 1>(of, width, at); break;
                case 2: addSlots<Real, 2>(of, width, at); break;
                case 3: addSlots<Real, 3>(of, width, at); break;
                default: addSlots<Real, 4>(of, width, at);
            }
        }
    }
}

}  // namespace
}  // namespace taut::mechanics::TAUT_ISA
