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
// Where all twists have one coefficient t, which is where nothing is cut, the last term is t times the second
// difference across of that along, of neighbours that are there. So t times the second difference along is added to
// `across`, and `twist` is not needed: half the work.
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
    const Real *along = batch.along + start, *across = batch.across + start;
    Real *alongs = m.along, *acrosses = m.across, *twists = m.twist;
    const Real even = batch.evenTwist;
    alongs[0] = alongs[n - 1] = 0;
    for (int i = 0; i<n; i += n> 1 ? n - 1 : 1) {
        const Real d = i > 0 ? here[i - 1] - here[i] : n > 1 ? here[i + 1] - here[i] : Real(0);
        acrosses[i] = across[i] * ((above[i] - here[i]) + (below[i] - here[i])) + even * d;
    }
    TAUT_INDEPENDENT
    for (int i = 1; i < n - 1; ++i) {
        const Real d = (here[i - 1] - here[i]) + (here[i + 1] - here[i]);
        const Real e = (above[i] - here[i]) + (below[i] - here[i]);
        alongs[i] = along[i] * d;
        acrosses[i] = across[i] * e + even * d;
    }
    if (batch.both) {
        const Real* both = batch.both + start;
        TAUT_INDEPENDENT
        for (int i = 1; i < n - 1; ++i) {
            alongs[i] += both[i] * ((above[i] - here[i]) + (below[i] - here[i]));
            acrosses[i] += both[i] * ((here[i - 1] - here[i]) + (here[i + 1] - here[i]));
        }
    }
    if (!batch.twist) return;
    const Real* twist = batch.twist + start;
    twists[n - 1] = 0;
    TAUT_INDEPENDENT
    for (int i = 0; i < n - 1; ++i) twists[i] = twist[i] * ((here[i] - here[i + 1]) - (below[i] - below[i + 1]));
}

// The rows above and below are the row itself where there is none.
template <class Real>
void addRow(const BendingBatch<Real>& batch, int row, const Moments<Real>& above, const Moments<Real>& here,
            const Moments<Real>& below, Real* f) {
    const int n = batch.columns;
    Real* out = f + static_cast<long>(row) * n;
    const Real *m = here.along, *up = above.across, *mid = here.across, *down = below.across;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i)
        out[i] -= ((m[i - 1] - m[i]) + (m[i + 1] - m[i])) + ((up[i] - mid[i]) + (down[i] - mid[i]));
    if (!batch.twist) return;
    const Real *t = here.twist, *u = above.twist;
    if (row > 0) {
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) out[i] -= (t[i] - t[i - 1]) - (u[i] - u[i - 1]);
    } else {
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) out[i] -= t[i] - t[i - 1];
    }
}

}  // namespace

template <class Real>
void addBending(const BendingBatch<Real>& batch) {
    const int pitch = bendingPitch(batch.columns);
    __builtin_memset(batch.room, 0, sizeof(Real) * static_cast<unsigned long>(bendingRoom(batch.columns)));
    Moments<Real> of[3][3];  // of each axis; row j is at j % 3
    for (int slot = 0; slot < 9; ++slot) {
        Real* at = batch.room + 3L * slot * pitch + 16;
        of[slot / 3][slot % 3] = {at, at + pitch, at + 2L * pitch};
    }
    for (int row = batch.first > 0 ? batch.first - 1 : 0; row <= batch.first; ++row)
        for (int axis = 0; axis < 3; ++axis) findMoments(batch, row, batch.x[axis], of[axis][row % 3]);
    for (int row = batch.first; row < batch.last; ++row)
        for (int axis = 0; axis < 3; ++axis) {
            const int above = row > 0 ? row - 1 : row, below = row + 1 < batch.rows ? row + 1 : row;
            const Moments<Real>* moments = of[axis];
            if (below != row) findMoments(batch, below, batch.x[axis], moments[below % 3]);
            addRow(batch, row, moments[above % 3], moments[row % 3], moments[below % 3], batch.f[axis]);
        }
}
template void addBending(const BendingBatch<float>&);
template void addBending(const BendingBatch<double>&);

}  // namespace taut::mechanics::TAUT_ISA
