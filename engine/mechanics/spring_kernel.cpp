// Compiled once for each instruction set; see taut_kernel in engine/taut.cmake.
//
// Hooke's law with a dashpot along the spring, d = x_b - x_a, l = |d|, n = d/l:
//   F_a = [k (l - L) + τ k (v_b - v_a)·n] n = k [1 - L/l + τ (v_b - v_a)·d/l²] d,   F_b = -F_a
// Each spring is evaluated once. At l = 0 the direction is undefined and the force zero; with L = 0 the force is
// k d, linear through l = 0.
#include "core/vectorise.h"
#include "mechanics/spring_kernels.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

inline float root(float x) { return __builtin_sqrtf(x); }
inline double root(double x) { return __builtin_sqrt(x); }

// The factor of d in F_a. In double the smallest length that counts is where its square leaves the range; the
// product with a zero d makes what lies below harmless.
template <class Real, bool damped>
inline Real factor(Real dx, Real dy, Real dz, Real ux, Real uy, Real uz, Real k, Real rest, Real tau) {
    const Real l = root(dx * dx + dy * dy + dz * dz);
    const Real inverse = l > Real(0) ? Real(1) / l : Real(0);
    Real pull = Real(1) - rest * inverse;
    if (damped) pull += tau * (ux * dx + uy * dy + uz * dz) * (inverse * inverse);
    return k * pull;
}

template <class Real, bool damped, bool overlapping>
inline void run(const SpringRunArgs<Real>& s) {
    const int n = s.n;
    const long stride = s.stride, strideB = s.strideB;
    const Real *xa = s.x, *ya = xa + stride, *za = ya + stride;
    const Real *xb = xa + s.offset, *yb = ya + s.offset, *zb = za + s.offset;
    const Real *ua = s.v, *va = ua + stride, *wa = va + stride;
    const Real *ub = ua + s.offset, *vb = va + s.offset, *wb = wa + s.offset;
    Real *fxa = s.fa, *fya = fxa + stride, *fza = fya + stride;
    Real *fxb = s.fb, *fyb = fxb + strideB, *fzb = fyb + strideB;
    Real *gx = s.scratch, *gy = gx + n, *gz = gy + n;
    const Real* k = s.k;
    const Real rest = s.restLength, tau = s.tau;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Real dx = xb[i] - xa[i], dy = yb[i] - ya[i], dz = zb[i] - za[i];
        Real ux = 0, uy = 0, uz = 0;
        if (damped) {
            ux = ub[i] - ua[i];
            uy = vb[i] - va[i];
            uz = wb[i] - wa[i];
        }
        const Real pull = factor<Real, damped>(dx, dy, dz, ux, uy, uz, k[i], rest, tau);
        const Real fx = pull * dx, fy = pull * dy, fz = pull * dz;
        fxa[i] += fx;
        fya[i] += fy;
        fza[i] += fz;
        if (overlapping) {
            gx[i] = fx;
            gy[i] = fy;
            gz[i] = fz;
        } else {
            fxb[i] -= fx;
            fyb[i] -= fy;
            fzb[i] -= fz;
        }
    }
    if (!overlapping) return;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        fxb[i] -= gx[i];
        fyb[i] -= gy[i];
        fzb[i] -= gz[i];
    }
}

template <class Real>
inline void runAny(const SpringRunArgs<Real>& s) {
    const bool damped = s.tau != Real(0);
    if (s.scratch != nullptr) {
        if (damped)
            run<Real, true, true>(s);
        else
            run<Real, false, true>(s);
    } else {
        if (damped)
            run<Real, true, false>(s);
        else
            run<Real, false, false>(s);
    }
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
            const Real pull = factor<Real, true>(d[0][i], d[1][i], d[2][i], u[0][i], u[1][i], u[2][i], k[i], rest[i],
                                                 tau[i]);
            d[0][i] *= pull;
            d[1][i] *= pull;
            d[2][i] *= pull;
        }
        for (int p = 0; p < 3; ++p) {
            Real *fa = s.fa + static_cast<long>(p) * s.stride, *fb = s.fb + static_cast<long>(p) * s.strideB;
            for (int i = 0; i < n; ++i) {
                fa[a[i]] += d[p][i];
                fb[b[i] - s.firstB] -= d[p][i];
            }
        }
    }
}

template <class Real>
inline void scale(int n, const Real* inverseMass, Real* f) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) f[i] *= inverseMass[i];
}

}  // namespace

void springRunFloat(const SpringRunArgs<float>& s) { runAny(s); }
void springRunDouble(const SpringRunArgs<double>& s) { runAny(s); }
void springListFloat(const SpringListArgs<float>& s) { list(s); }
void springListDouble(const SpringListArgs<double>& s) { list(s); }
void scaleFloat(int n, const float* inverseMass, float* f) { scale(n, inverseMass, f); }
void scaleDouble(int n, const double* inverseMass, double* f) { scale(n, inverseMass, f); }

}  // namespace taut::mechanics::TAUT_ISA
