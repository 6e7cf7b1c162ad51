// Compiled once for each instruction set (engine/taut.cmake). It uses only + - *, and no sum across lanes, so every
// width gives the same bits.
//
// The energy is ½ xᵀ Dᵀ C D x with second differences D, so the force is -Dᵀ (C D x). First come the moments C D x at
// the centres of folds and cells, then their second differences. It keeps the moments of three rows, so that each place
// is read once and each force is written once:
//
//   row j - 1   across, twist                    f_j = -( second difference of `along` in row j
//   row j       along, across, twist     ->              + second difference of `across` over j - 1, j, j + 1
//   row j + 1   across                                   + mixed difference of `twist` in j - 1, j )
//
// It takes differences of edges, not of places, so that single precision loses as little as possible.
#include "taut/mechanics/private/bending_kernel.h"

#include "taut/core/private/vectorise.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

// Moments of one row. Entries -1 and `columns` are 0.
template <class Real>
struct Moments {
    Real *along, *across, *twist;
};

template <class Real>
void findMoments(const BendingBatch<Real>& batch, int row, const Real* x, const Moments<Real>& m) {
    const int n = batch.columns;
    const long start = static_cast<long>(row) * n;
    const Real *here = x + start, *above = row > 0 ? here - n : here, *below = row + 1 < batch.rows ? here + n : here;
    const Real *along = batch.along + start, *across = batch.across + start, *both = batch.both + start,
               *twist = batch.twist + start;
    Real *alongs = m.along, *acrosses = m.across, *twists = m.twist;
    alongs[0] = alongs[n - 1] = twists[n - 1] = 0;
    for (int i = 0; i < n; i += n > 1 ? n - 1 : 1)
        acrosses[i] = across[i] * ((above[i] - here[i]) + (below[i] - here[i]));
    TAUT_INDEPENDENT
    for (int i = 1; i < n - 1; ++i) {
        const Real d = (here[i - 1] - here[i]) + (here[i + 1] - here[i]);
        const Real e = (above[i] - here[i]) + (below[i] - here[i]);
        alongs[i] = along[i] * d + both[i] * e;
        acrosses[i] = across[i] * e + both[i] * d;
    }
    TAUT_INDEPENDENT
    for (int i = 0; i < n - 1; ++i) twists[i] = twist[i] * ((here[i] - here[i + 1]) - (below[i] - below[i + 1]));
}

template <class Real>
void addRow(const BendingBatch<Real>& batch, int row, const Moments<Real>& above, const Moments<Real>& here,
            const Moments<Real>& below, Real* f) {
    Real* out = f + static_cast<long>(row) * batch.columns;
    const Real *m = here.along, *up = above.across, *mid = here.across, *down = below.across, *t = here.twist,
               *u = above.twist;
    TAUT_INDEPENDENT
    for (int i = 0; i < batch.columns; ++i)
        out[i] -= ((m[i - 1] - m[i]) + (m[i + 1] - m[i])) + ((up[i] - mid[i]) + (down[i] - mid[i])) +
                  ((t[i] - t[i - 1]) - (u[i] - u[i - 1]));
}

template <class Real>
void addAll(const BendingBatch<Real>& batch) {
    const int pitch = bendingPitch(batch.columns);
    Moments<Real> of[3];  // row j is at j % 3
    for (int slot = 0; slot < 3; ++slot) {
        Real* at = batch.room + 3L * slot * pitch + 16;
        of[slot] = {at, at + pitch, at + 2L * pitch};
    }
    for (int axis = 0; axis < 3; ++axis) {
        __builtin_memset(batch.room, 0, sizeof(Real) * 9UL * static_cast<unsigned long>(pitch));
        const Real* x = batch.x[axis];
        if (batch.first > 0) findMoments(batch, batch.first - 1, x, of[(batch.first - 1) % 3]);
        findMoments(batch, batch.first, x, of[batch.first % 3]);
        for (int row = batch.first; row < batch.last; ++row) {
            const Moments<Real>& below = of[(row + 1) % 3];
            if (row + 1 < batch.rows)
                findMoments(batch, row + 1, x, below);
            else
                __builtin_memset(below.across, 0, sizeof(Real) * static_cast<unsigned long>(batch.columns));
            addRow(batch, row, of[(row + 2) % 3], of[row % 3], below, batch.f[axis]);
        }
    }
}

}  // namespace

void addBending(const BendingBatch<float>& batch) {
    addAll(batch);
}
void addBending(const BendingBatch<double>& batch) {
    addAll(batch);
}

}  // namespace taut::mechanics::TAUT_ISA
