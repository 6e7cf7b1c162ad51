// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
#include "taut/mechanics/dashpot_kernel.h"

#include "taut/core/private/vectorise.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

// Dashpots at once, so that data between the loops stays in the first-level cache.
constexpr int dashpotSlice = 256;

template <class Real>
struct Slice {
    // Impulses over lengths. There is room on both sides for missing neighbours, whose impulse is 0.
    alignas(64) Real p[3 * dashpotSlice], again[3 * dashpotSlice];
    alignas(64) Real dx[dashpotSlice], dy[dashpotSlice], dz[dashpotSlice], half[dashpotSlice], up[dashpotSlice],
        down[dashpotSlice];
};

// Planes at both ends of dashpots.
template <class T>
struct Ends {
    Ends(T* planes, long stride, int offset)
        : ax(planes), ay(ax + stride), az(ay + stride), bx(ax + offset), by(ay + offset), bz(az + offset) {}
    T *ax, *ay, *az, *bx, *by, *bz;
};

// n dashpots that share no point.
template <class Real>
inline void dampApart(const DashpotRun<Real>& s, int first, int n) {
    const Ends<const Real> x(s.x + first, s.stride, s.offset);
    const Ends<Real> v(s.v + first, s.stride, s.offset);
    const Real *g = s.g + first, *wa = s.w + first, *wb = wa + s.offset;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Real dx = x.bx[i] - x.ax[i], dy = x.by[i] - x.ay[i], dz = x.bz[i] - x.az[i];
        const Real square = dx * dx + dy * dy + dz * dz;
        const Real factor = square > Real(0) ? g[i] / square : Real(0);
        const Real p = factor * ((v.bx[i] - v.ax[i]) * dx + (v.by[i] - v.ay[i]) * dy + (v.bz[i] - v.az[i]) * dz);
        const Real atA = wa[i] * p, atB = wb[i] * p;
        v.ax[i] += atA * dx;
        v.ay[i] += atA * dy;
        v.az[i] += atA * dz;
        v.bx[i] -= atB * dx;
        v.by[i] -= atB * dy;
        v.bz[i] -= atB * dz;
    }
}

// Computes the impulses of n dashpots from `first` on as if they shared no point. `half` is half the factor from
// approach times length to impulse.
template <class Real>
inline void impulses(const DashpotRun<Real>& s, int first, int n, Slice<Real>& b) {
    const Ends<const Real> x(s.x + first, s.stride, s.offset), u(s.v + first, s.stride, s.offset);
    const Real* g = s.g + first;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Real dx = x.bx[i] - x.ax[i], dy = x.by[i] - x.ay[i], dz = x.bz[i] - x.az[i];
        const Real square = dx * dx + dy * dy + dz * dz;
        const Real factor = square > Real(0) ? g[i] / square : Real(0);
        b.p[dashpotSlice + i] =
            factor * ((u.bx[i] - u.ax[i]) * dx + (u.by[i] - u.ay[i]) * dy + (u.bz[i] - u.az[i]) * dz);
        b.half[i] = Real(0.5) * factor;
        b.dx[i] = dx;
        b.dy[i] = dy;
        b.dz[i] = dz;
    }
}

// Dashpots i and i + offset share a point. Through it the impulse of one changes the velocity of the other:
//   p_i = p_i alone + up_i p_{i+offset} + down_i p_{i-offset}.
template <class Real>
inline void couplings(const DashpotRun<Real>& s, int first, int n, Slice<Real>& b) {
    const int offset = s.offset, pairs = n - offset;
    const Real* w = s.w + first + offset;
    for (int i = 0; i < n; ++i) b.up[i] = b.down[i] = Real(0);
    TAUT_INDEPENDENT
    for (int i = 0; i < pairs; ++i) {
        const Real turn = w[i] * (b.dx[i] * b.dx[i + offset] + b.dy[i] * b.dy[i + offset] + b.dz[i] * b.dz[i + offset]);
        b.up[i] = b.half[i] * turn;
        b.down[i + offset] = b.half[i + offset] * turn;
    }
}

// Solves the couplings by repeated substitution. The error shrinks by y/(1 + y) each time.
template <class Real>
inline void coupleLoosely(int offset, int n, Slice<Real>& b) {
    constexpr int times = 4;
    Real *alone = b.half, *p = b.p + dashpotSlice, *next = b.again + dashpotSlice;
    for (int i = 0; i < n; ++i) alone[i] = p[i];
    for (int i = 1; i <= offset; ++i) p[-i] = p[n + i - 1] = next[-i] = next[n + i - 1] = Real(0);
    for (int time = 0; time < times; ++time) {
        const Real *lower = p - offset, *upper = p + offset;
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) next[i] = alone[i] + (b.up[i] * upper[i] + b.down[i] * lower[i]);
        Real* const last = p;
        p = next;
        next = last;
    }
}

// Solves the couplings by elimination along each chain of springs.
template <class Real>
inline void coupleStiffly(int offset, int n, Slice<Real>& b) {
    Real *p = b.p + dashpotSlice, *pivot = b.again + dashpotSlice;
    for (int i = 0; i < n; ++i) {
        const Real factor = i < offset ? Real(0) : b.down[i] / pivot[i - offset];
        pivot[i] = i < offset ? Real(1) : Real(1) - factor * b.up[i - offset];
        if (i >= offset) p[i] += factor * p[i - offset];
    }
    for (int i = n - 1; i >= 0; --i) p[i] = (i + offset < n ? p[i] + b.up[i] * p[i + offset] : p[i]) / pivot[i];
}

template <class Real>
inline void apply(const DashpotRun<Real>& s, int first, int n, Slice<Real>& b) {
    const long stride = s.stride, offset = s.offset;
    const Real *wa = s.w + first, *wb = wa + offset, *p = b.p + dashpotSlice;
    const Real* const ways[3] = {b.dx, b.dy, b.dz};
    for (int axis = 0; axis < 3; ++axis) {
        Real *va = s.v + first + axis * stride, *vb = va + offset;
        const Real* way = ways[axis];
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) va[i] += wa[i] * (p[i] * way[i]);
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) vb[i] -= wb[i] * (p[i] * way[i]);
    }
}

template <class Real>
inline void dampSlice(const DashpotRun<Real>& s, int first, int n, Slice<Real>& b) {
    if (s.offset >= n) return dampApart(s, first, n);
    impulses(s, first, n, b);
    if (s.offset < n) couplings(s, first, n, b);
    if (s.offset < n && s.isStiff)
        coupleStiffly(s.offset, n, b);
    else if (s.offset < n)
        coupleLoosely(s.offset, n, b);
    apply(s, first, n, b);
}

}  // namespace

template <class Real>
void dampRun(const DashpotRun<Real>& s) {
    Slice<Real> b;
    const int count = (s.n + dashpotSlice - 1) / dashpotSlice;
    for (int i = 0; i < count; ++i) {
        const int first = (s.isForwards ? i : count - 1 - i) * dashpotSlice;
        dampSlice(s, first, s.n - first < dashpotSlice ? s.n - first : dashpotSlice, b);
    }
}
template void dampRun(const DashpotRun<float>&);
template void dampRun(const DashpotRun<double>&);

// The part from the places is computed for a whole batch at once, the part from the velocities one dashpot after the
// other.
template <class Real>
void dampList(const DashpotList<Real>& s) {
    constexpr int batch = 64;
    alignas(64) Real d[3][batch], factor[batch];
    const int count = (s.n + batch - 1) / batch;
    for (int number = 0; number < count; ++number) {
        const int first = (s.isForwards ? number : count - 1 - number) * batch;
        const int n = s.n - first < batch ? s.n - first : batch;
        const int *a = s.a + first, *b = s.b + first;
        for (int axis = 0; axis < 3; ++axis) {
            const Real* x = s.x + static_cast<long>(axis) * s.stride;
            for (int i = 0; i < n; ++i) d[axis][i] = x[b[i]] - x[a[i]];
        }
        const Real* g = s.g + first;
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) {
            const Real square = d[0][i] * d[0][i] + d[1][i] * d[1][i] + d[2][i] * d[2][i];
            factor[i] = square > Real(0) ? g[i] / square : Real(0);
        }
        Real *vx = s.v, *vy = vx + s.stride, *vz = vy + s.stride;
        for (int j = 0; j < n; ++j) {
            const int i = s.isForwards ? j : n - 1 - j, from = a[i], to = b[i];
            const Real p = factor[i] * ((vx[to] - vx[from]) * d[0][i] + (vy[to] - vy[from]) * d[1][i] +
                                        (vz[to] - vz[from]) * d[2][i]);
            const Real atA = s.w[from] * p, atB = s.w[to] * p;
            vx[from] += atA * d[0][i];
            vy[from] += atA * d[1][i];
            vz[from] += atA * d[2][i];
            vx[to] -= atB * d[0][i];
            vy[to] -= atB * d[1][i];
            vz[to] -= atB * d[2][i];
        }
    }
}
template void dampList(const DashpotList<float>&);
template void dampList(const DashpotList<double>&);

}  // namespace taut::mechanics::TAUT_ISA
