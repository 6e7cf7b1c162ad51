// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
//
// Hooke's law with a dashpot along the spring, d = x_b - x_a, l = |d|, n = d/l:
//   F_a = k [l - L + τ u·n] n = k [1 - (L - τ u·d/l)/l] d,   u = v_b - v_a,   F_b = -F_a
// Each spring is evaluated once. At l = 0 the direction is undefined, and the force is zero. With L = 0 the force is
// k d, linear through l = 0.
#include "taut/core/private/vectorise.h"
#include "taut/core/private/vectors.h"
#include "taut/mechanics/private/packed_points.h"
#include "taut/mechanics/spring_kernels.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

using core::TAUT_ISA::larger;
using core::TAUT_ISA::load;
using core::TAUT_ISA::NarrowVector;
using core::TAUT_ISA::root;
using core::TAUT_ISA::store;
using core::TAUT_ISA::WideVector;

// [m²] A smaller l² counts as this, so that 1/l is finite at l = 0, where d makes the force zero. These are the
// smallest normal numbers; 1/l² is finite too.
inline float least(float) {
    return 0x1p-126F;
}
inline double least(double) {
    return 0x1p-1022;
}

// The factor of F_a = factor · c, with c = x_a - x_b: k [(L - τ u·d/l)/l - 1]. It is finite no matter how small l is.
// Here u = v_a - v_b; these signs save instructions.
template <class Real, bool damped, class V>
inline V factor(V cx, V cy, V cz, V uc, V k, V rest, V tau) {
    const V squared = cx * cx + cy * cy + cz * cz;
    const V inverse = Real(1) / root(larger(squared, V{} + least(Real())));
    if (damped) return ((rest - uc * inverse * tau) * inverse - Real(1)) * k;
    return (rest * inverse - Real(1)) * k;
}

// Springs of each run that are computed at once. Their pulls wait until all are done, because end a of one spring may
// be end b of another. Meanwhile the pulls stay in the first-level cache.
template <class Real>
constexpr int springSlice = 1024 / static_cast<int>(sizeof(Real));

// Runs whose offsets differ by no more than this are taken off the forces together. So each force is loaded and stored
// once for all of them, and is not loaded while its last store is still on its way to the cache.
constexpr int margin = 4;

// The pulls to take off the forces. The pull on point b of a spring is stored at the spring's point a, run by run. The
// pulls on the points a are summed over the runs with the opposite sign, as a run of offset 0. Zeros surround each run.
template <class Real>
struct Pulls {
    static constexpr int line = 64 / static_cast<int>(sizeof(Real));
    static constexpr int plane = line + springSlice<Real> + line;
    alignas(64) Real of[1 + mostTogether][3][plane];
    // The values of each run, repeated for every lane.
    alignas(64) Real rest[mostTogether][line], tau[mostTogether][line];
};

// Computes the springs i … of all runs, as many as V has lanes, in the slice that begins with spring `first`.
template <class V, class Real, bool damped, bool mixed>
inline void pull(const SpringBundleArgs<Real>& s, int first, int i, Pulls<Real>& pulls) {
    const long stride = s.stride;
    const Real *x = s.x + first + i, *y = x + stride, *z = y + stride;
    const Real *u = s.v + first + i, *v = u + stride, *w = v + stride;
    const V xa = load<V>(x), ya = load<V>(y), za = load<V>(z);
    V ua{}, va{}, wa{}, sx{}, sy{}, sz{};
    if (damped) {
        ua = load<V>(u);
        va = load<V>(v);
        wa = load<V>(w);
    }
    const Real* k = s.stiffness + first + i;
    Real* to = pulls.of[0][0] + Pulls<Real>::line + i;
    constexpr int plane = Pulls<Real>::plane;
    const int together = s.runs->together;
    for (int r = 0; r < together; ++r) {
        const SpringRun<Real>& run = s.runs[r];
        const long offset = run.offset;
        const V cx = xa - load<V>(x + offset), cy = ya - load<V>(y + offset), cz = za - load<V>(z + offset);
        V uc{};
        if (damped)
            uc = (ua - load<V>(u + offset)) * cx + (va - load<V>(v + offset)) * cy + (wa - load<V>(w + offset)) * cz;
        const Real *rest = pulls.rest[r], *tau = pulls.tau[r];
        if (mixed && run.mixed >= 0) {
            rest = s.mixed + run.mixed + first + i;
            tau = rest + run.count;
        }
        const V f = factor<Real, damped>(cx, cy, cz, uc, load<V>(k + run.table), load<V>(rest), load<V>(tau));
        const V fx = f * cx, fy = f * cy, fz = f * cz;
        Real* own = to + static_cast<long>(r + 1) * (3 * plane);
        store(own, fx);
        store(own + plane, fy);
        store(own + 2 * plane, fz);
        sx -= fx;
        sy -= fy;
        sz -= fz;
    }
    store(to, sx);
    store(to + plane, sy);
    store(to + 2 * plane, sz);
}

// The last vector of a slice may overlap the one before. Then it computes some springs again, with the same result.
template <class V, class Real, bool damped, bool mixed>
inline void pullAll(const SpringBundleArgs<Real>& s, int first, int n, Pulls<Real>& pulls) {
    constexpr int lanes = sizeof(V) / sizeof(Real);
    int i = 0;
    for (; i + lanes <= n; i += lanes) pull<V, Real, damped, mixed>(s, first, i, pulls);
    if (i < n) pull<V, Real, damped, mixed>(s, first, n - lanes, pulls);
}

// Takes the pulls of `count` runs off n forces.
template <class Real, int count>
inline void takeOff(Real* f, long stride, const Real* const* pulls, int n) {
    constexpr int plane = Pulls<Real>::plane;
    Real *fx = f, *fy = fx + stride, *fz = fy + stride;
    const Real *p0 = pulls[0], *p1 = pulls[1], *p2 = pulls[2], *p3 = pulls[3];
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        Real x = fx[i] - p0[i], y = fy[i] - p0[i + plane], z = fz[i] - p0[i + 2 * plane];
        if (count > 1) {
            x -= p1[i];
            y -= p1[i + plane];
            z -= p1[i + 2 * plane];
        }
        if (count > 2) {
            x -= p2[i];
            y -= p2[i + plane];
            z -= p2[i + 2 * plane];
        }
        if (count > 3) {
            x -= p3[i];
            y -= p3[i + plane];
            z -= p3[i + 2 * plane];
        }
        fx[i] = x;
        fy[i] = y;
        fz[i] = z;
    }
}

// Takes all pulls of a slice of n off the forces. f: at the first point a of the slice.
template <class Real>
inline void takeOff(const SpringBundleArgs<Real>& s, Real* f, int n, Pulls<Real>& pulls) {
    constexpr int line = Pulls<Real>::line, most = 4;
    const int runs = 1 + s.runs->together;
    const auto offset = [&](int r) { return r == 0 ? 0 : s.runs[r - 1].offset; };
    for (int from = 0, to = 0; from < runs; from = to) {
        to = from + 1;
        while (to < runs && to - from < most && offset(to) >= offset(from) && offset(to) <= offset(from) + margin) ++to;
        const Real* of[most] = {};
        for (int r = from; r < to; ++r) {
            of[r - from] = pulls.of[r][0] + line + offset(from) - offset(r);
            if (to - from == 1) break;
            for (auto& plane : pulls.of[r]) {
                __builtin_memset(plane + line - margin, 0, margin * sizeof(Real));
                __builtin_memset(plane + line + n, 0, margin * sizeof(Real));
            }
        }
        const int width = n + offset(to - 1) - offset(from);
        Real* at = f + offset(from);
        switch (to - from) {
            case 1: takeOff<Real, 1>(at, s.windowStride, of, width); break;
            case 2: takeOff<Real, 2>(at, s.windowStride, of, width); break;
            case 3: takeOff<Real, 3>(at, s.windowStride, of, width); break;
            default: takeOff<Real, 4>(at, s.windowStride, of, width);
        }
    }
}

template <class Real, bool damped, bool mixed>
inline void bundle(const SpringBundleArgs<Real>& s) {
    constexpr int narrow = sizeof(NarrowVector<Real>) / sizeof(Real), wide = sizeof(WideVector<Real>) / sizeof(Real);
    Pulls<Real> pulls;
    for (int r = 0; r < s.runs->together; ++r)
        for (int i = 0; i < Pulls<Real>::line; ++i) {
            pulls.rest[r][i] = s.runs[r].restLength;
            pulls.tau[r][i] = s.runs[r].tau;
        }
    for (int first = 0; first < s.runs->count; first += springSlice<Real>) {
        const int n = s.runs->count - first < springSlice<Real> ? s.runs->count - first : springSlice<Real>;
        if (n >= wide)
            pullAll<WideVector<Real>, Real, damped, mixed>(s, first, n, pulls);
        else if (n >= narrow)
            pullAll<NarrowVector<Real>, Real, damped, mixed>(s, first, n, pulls);
        else
            pullAll<Real, Real, damped, mixed>(s, first, n, pulls);
        takeOff(s, s.f + first, n, pulls);
    }
}

template <class Real>
inline void bundleAny(const SpringBundleArgs<Real>& s) {
    bool damped = false, mixed = false;
    for (int r = 0; r < s.runs->together; ++r) {
        damped = damped || s.runs[r].tau != Real(0);
        mixed = mixed || s.runs[r].mixed >= 0;
    }
    if (mixed)
        bundle<Real, true, true>(s);
    else if (damped)
        bundle<Real, true, false>(s);
    else
        bundle<Real, false, false>(s);
}

// Gathers a batch into planar buffers, computes it all at once, and scatters it spring by spring in order.
template <class Real>
inline void list(const SpringListArgs<Real>& s) {
    constexpr int batch = 64;
    alignas(64) Real d[3][batch], u[3][batch];
    for (int first = 0; first < s.n; first += batch) {
        const int n = s.n - first < batch ? s.n - first : batch;
        const int *a = s.a + first, *b = s.b + first;
        for (int p = 0; p < 3; ++p) {
            const Real *x = s.x + static_cast<long>(p) * s.stride, *v = s.v + static_cast<long>(p) * s.stride;
            for (int i = 0; i < n; ++i) {
                d[p][i] = x[a[i]] - x[b[i]];
                u[p][i] = v[a[i]] - v[b[i]];
            }
        }
        const Real *k = s.k + first, *rest = s.restLength + first, *tau = s.tau + first;
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) {
            const Real uc = u[0][i] * d[0][i] + u[1][i] * d[1][i] + u[2][i] * d[2][i];
            const Real pull = factor<Real, true>(d[0][i], d[1][i], d[2][i], uc, k[i], rest[i], tau[i]);
            d[0][i] *= pull;
            d[1][i] *= pull;
            d[2][i] *= pull;
        }
        for (int p = 0; p < 3; ++p) {
            Real* f = s.f + static_cast<long>(p) * s.windowStride;
            for (int i = 0; i < n; ++i) {
                f[a[i] - s.windowFirst] += d[p][i];
                f[b[i] - s.windowFirst] -= d[p][i];
            }
        }
    }
}

// The same for packed points: a point's state is two vectors, its force is one.
template <class Real>
inline void packedList(const PackedSpringArgs<Real>& s) {
    constexpr int batch = 64;
    alignas(64) Real c[batch][4], u[batch][4], pull[batch];
    const Real* state = s.state - static_cast<long>(s.windowFirst) * packedState;
    Real* f = s.f - static_cast<long>(s.windowFirst) * packedForce;
    for (int first = 0; first < s.n; first += batch) {
        const int n = s.n - first < batch ? s.n - first : batch;
        const int *a = s.a + first, *b = s.b + first;
        // Gather: differences of places and velocities.
        for (int i = 0; i < n; ++i) {
            const Real *from = state + static_cast<long>(a[i]) * packedState,
                       *to = state + static_cast<long>(b[i]) * packedState;
            Four<Real> xa, xb, va, vb;
            fetch(from, xa);
            fetch(to, xb);
            fetch(from + 4, va);
            fetch(to + 4, vb);
            xa -= xb;
            va -= vb;
            put(c[i], xa);
            put(u[i], va);
        }
        const Real *k = s.k + first, *rest = s.restLength + first, *tau = s.tau + first;
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) {
            const Real uc = u[i][0] * c[i][0] + u[i][1] * c[i][1] + u[i][2] * c[i][2];
            pull[i] = factor<Real, true>(c[i][0], c[i][1], c[i][2], uc, k[i], rest[i], tau[i]);
        }
        // Scatter in order, because springs share points.
        for (int i = 0; i < n; ++i) {
            Real *atA = f + static_cast<long>(a[i]) * packedForce, *atB = f + static_cast<long>(b[i]) * packedForce;
            Four<Real> d, fa, fb;
            fetch(c[i], d);
            fetch(atA, fa);
            fetch(atB, fb);
            d *= pull[i];
            fa += d;
            fb -= d;
            put(atA, fa);
            put(atB, fb);
        }
    }
}

template <class Real>
inline void pack(const PackArgs<Real>& s) {
    const long stride = s.stride;
    const Real *x = s.x, *y = x + stride, *z = y + stride, *u = s.v, *v = u + stride, *w = v + stride;
    for (int i = 0; i < s.n; ++i) {
        Real *point = s.state + i * packedState, *force = s.f + i * packedForce;
        point[0] = x[i];
        point[1] = y[i];
        point[2] = z[i];
        point[3] = 0;
        point[4] = u[i];
        point[5] = v[i];
        point[6] = w[i];
        point[7] = 0;
        force[0] = force[1] = force[2] = force[3] = 0;
    }
}

template <class Real>
inline void unpack(const UnpackArgs<Real>& s) {
    Real *fx = s.f, *fy = fx + s.windowStride, *fz = fy + s.windowStride;
    TAUT_INDEPENDENT
    for (int i = 0; i < s.n; ++i) {
        fx[i] += s.packed[i * packedForce];
        fy[i] += s.packed[i * packedForce + 1];
        fz[i] += s.packed[i * packedForce + 2];
    }
}

template <class Real, bool pushed>
inline void accelerate(const AccelerationArgs<Real>& s) {
    const long externalStride = pushed ? s.externalStride : 0;
    const Real *ex = s.external, *ey = ex + externalStride, *ez = ey + externalStride;
    Real *fx = s.f, *fy = fx + s.windowStride, *fz = fy + s.windowStride;
    const Real* inverseMass = s.inverseMass;
    const Real gx = s.uniform[0], gy = s.uniform[1], gz = s.uniform[2];
    TAUT_INDEPENDENT
    for (int i = 0; i < s.n; ++i) {
        const Real w = inverseMass[i];
        const Real free = w > Real(0) ? Real(1) : Real(0);
        fx[i] = (pushed ? fx[i] + ex[i] : fx[i]) * w + free * gx;
        fy[i] = (pushed ? fy[i] + ey[i] : fy[i]) * w + free * gy;
        fz[i] = (pushed ? fz[i] + ez[i] : fz[i]) * w + free * gz;
    }
}

template <class Real>
inline void accelerateAny(const AccelerationArgs<Real>& s) {
    if (s.external != nullptr)
        accelerate<Real, true>(s);
    else
        accelerate<Real, false>(s);
}

}  // namespace

template <class Real>
SpringKernels<Real> springKernels() {
    return {bundleAny<Real>, list<Real>, packedList<Real>, pack<Real>, unpack<Real>, accelerateAny<Real>};
}
template SpringKernels<float> springKernels();
template SpringKernels<double> springKernels();

}  // namespace taut::mechanics::TAUT_ISA
