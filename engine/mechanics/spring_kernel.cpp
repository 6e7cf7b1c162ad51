// Compiled once for each instruction set; see taut_kernel in engine/taut.cmake.
//
// Hooke's law with a dashpot along the spring, d = x_b - x_a, l = |d|, n = d/l:
//   F_a = k [l - L + τ u·n] n = k [1 - (L - τ u·d/l)/l] d,   u = v_b - v_a,   F_b = -F_a
// Each spring is evaluated once. At l = 0 the direction is undefined and the force zero; with L = 0 the force is
// k d, linear through l = 0.
#include "taut/core/vectorise.h"
#include "taut/mechanics/spring_kernels.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

inline float root(float x) {
    return __builtin_sqrtf(x);
}
inline double root(double x) {
    return __builtin_sqrt(x);
}

// The factor of d in F_a, as 1 - (L - τ u·d/l)/l: finite however small l is.
template <class Real, bool damped>
inline Real factor(Real dx, Real dy, Real dz, Real ux, Real uy, Real uz, Real k, Real rest, Real tau) {
    const Real l = root(dx * dx + dy * dy + dz * dz);
    const Real inverse = l > Real(0) ? Real(1) / l : Real(0);
    Real length = rest;  // at which the spring would be free of force
    if (damped) length -= tau * (ux * dx + uy * dy + uz * dz) * inverse;
    return k * (Real(1) - length * inverse);
}

// Springs at once. A run is cut so that between its ends, unless they are close, nothing overlaps; and what lies in
// between stays in the first-level cache.
constexpr int slice = 128;

// n <= slice springs of a run from the given one on. With both ends `apart` (offset >= n) forces go straight to
// both; else the ends b have to wait until all ends a are done. `mixed`: with rest lengths and damping times of their
// own.
template <class Real, bool damped, bool mixed, bool apart>
inline void runSlice(const SpringRunArgs<Real>& s, int first, int n) {
    const long stride = s.stride, windowStride = s.windowStride, offset = s.offset;
    const Real *xa = s.x + first, *ya = xa + stride, *za = ya + stride;
    const Real *xb = xa + offset, *yb = ya + offset, *zb = za + offset;
    const Real *ua = s.v + first, *va = ua + stride, *wa = va + stride;
    const Real *ub = ua + offset, *vb = va + offset, *wb = wa + offset;
    Real *fxa = s.f + first, *fya = fxa + windowStride, *fza = fya + windowStride;
    Real *fxb = fxa + offset, *fyb = fya + offset, *fzb = fza + offset;
    const Real* k = s.k + first;
    const Real rest = s.restLength, tau = s.tau;
    const Real *rests = mixed ? s.restLengths + first : nullptr, *taus = mixed ? s.taus + first : nullptr;
    alignas(64) Real gx[slice], gy[slice], gz[slice];
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Real dx = xb[i] - xa[i], dy = yb[i] - ya[i], dz = zb[i] - za[i];
        Real ux = 0, uy = 0, uz = 0;
        if (damped) {
            ux = ub[i] - ua[i];
            uy = vb[i] - va[i];
            uz = wb[i] - wa[i];
        }
        const Real pull =
            factor<Real, damped>(dx, dy, dz, ux, uy, uz, k[i], mixed ? rests[i] : rest, mixed ? taus[i] : tau);
        const Real fx = pull * dx, fy = pull * dy, fz = pull * dz;
        fxa[i] += fx;
        fya[i] += fy;
        fza[i] += fz;
        if (apart) {
            fxb[i] -= fx;
            fyb[i] -= fy;
            fzb[i] -= fz;
        } else {
            gx[i] = fx;
            gy[i] = fy;
            gz[i] = fz;
        }
    }
    if (apart) return;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        fxb[i] -= gx[i];
        fyb[i] -= gy[i];
        fzb[i] -= gz[i];
    }
}

template <class Real, bool damped, bool mixed>
inline void run(const SpringRunArgs<Real>& s) {
    for (int first = 0; first < s.n; first += slice) {
        const int n = s.n - first < slice ? s.n - first : slice;
        if (s.offset >= n)
            runSlice<Real, damped, mixed, true>(s, first, n);
        else
            runSlice<Real, damped, mixed, false>(s, first, n);
    }
}

template <class Real>
inline void runAny(const SpringRunArgs<Real>& s) {
    if (s.restLengths != nullptr)
        run<Real, true, true>(s);
    else if (s.tau != Real(0))
        run<Real, true, false>(s);
    else
        run<Real, false, false>(s);
}

// Gathers a batch into planar buffers, computes it side by side, scatters it spring by spring in order.
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
                d[p][i] = x[b[i]] - x[a[i]];
                u[p][i] = v[b[i]] - v[a[i]];
            }
        }
        const Real *k = s.k + first, *rest = s.restLength + first, *tau = s.tau + first;
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) {
            const Real pull =
                factor<Real, true>(d[0][i], d[1][i], d[2][i], u[0][i], u[1][i], u[2][i], k[i], rest[i], tau[i]);
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

void springRunFloat(const SpringRunArgs<float>& s) {
    runAny(s);
}
void springRunDouble(const SpringRunArgs<double>& s) {
    runAny(s);
}
void springListFloat(const SpringListArgs<float>& s) {
    list(s);
}
void springListDouble(const SpringListArgs<double>& s) {
    list(s);
}
void accelerateFloat(const AccelerationArgs<float>& s) {
    accelerateAny(s);
}
void accelerateDouble(const AccelerationArgs<double>& s) {
    accelerateAny(s);
}

}  // namespace taut::mechanics::TAUT_ISA
