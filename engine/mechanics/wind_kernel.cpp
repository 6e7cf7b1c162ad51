// Compiled once per instruction set (engine/taut.cmake). Only + - * / and square roots, no sum across lanes:
// the same bits for every width.
#include "taut/mechanics/wind_kernel.h"
#include "taut/core/vectorise.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

inline float root(float x) {
    return __builtin_sqrtf(x);
}
inline double root(double x) {
    return __builtin_sqrt(x);
}

// Adding and taking away 1.5 · 2^23 (2^52) rounds to the nearest whole number.
inline float nearestWhole(float x) {
    return (x + 12582912.0F) - 12582912.0F;
}
inline double nearestWhole(double x) {
    return (x + 6755399441055744.0) - 6755399441055744.0;
}

template <class Real>
struct Block {
    alignas(64) Real air[3][kernelBlock];     // air relative to the triangle [m/s]
    alignas(64) Real centre[3][kernelBlock];  // [m]
    alignas(64) Real gust[3][kernelBlock];    // [m/s]
    alignas(64) Real force[3][kernelBlock];   // a third of the triangle's [N]
};

// Three corners' planes of positions or velocities: [corner][axis].
template <class Real>
struct Corners {
    const Real* of[3][3];
};

template <class Real>
inline void findRelativeAir(const Corners<Real>& v, const Real* flow, int count, Block<Real>& block) {
    const Real third = Real(1.0 / 3.0);
    for (int axis = 0; axis < 3; ++axis) {
        const Real *a = v.of[0][axis], *b = v.of[1][axis], *c = v.of[2][axis];
        const Real steady = flow[axis];
        Real* air = block.air[axis];
        TAUT_INDEPENDENT
        for (int l = 0; l < count; ++l) air[l] = steady - (a[l] + b[l] + c[l]) * third;
    }
}

// The waves' sum g, bent to g/√(1 + g²/limit²).
template <class Real>
inline void addGust(const Corners<Real>& x, const GustWaves<Real>& waves, int count, Block<Real>& block) {
    const Real third = Real(1.0 / 3.0);
    const Real w0 = Real(gustWaveShape[0]), w1 = Real(gustWaveShape[1]), w2 = Real(gustWaveShape[2]);
    for (int axis = 0; axis < 3; ++axis) {
        const Real *a = x.of[0][axis], *b = x.of[1][axis], *c = x.of[2][axis];
        Real *centre = block.centre[axis], *gust = block.gust[axis];
        TAUT_INDEPENDENT
        for (int l = 0; l < count; ++l) {
            centre[l] = (a[l] + b[l] + c[l]) * third;
            gust[l] = Real(0);
        }
    }
    const Real *cx = block.centre[0], *cy = block.centre[1], *cz = block.centre[2];
    Real *gx = block.gust[0], *gy = block.gust[1], *gz = block.gust[2];
    for (int w = 0; w < gustWaveCount; ++w) {
        const Real kx = waves.wavenumber[0][w], ky = waves.wavenumber[1][w], kz = waves.wavenumber[2][w];
        const Real sx = waves.strength[0][w], sy = waves.strength[1][w], sz = waves.strength[2][w];
        const Real phase = waves.phase[w];
        TAUT_INDEPENDENT
        for (int l = 0; l < count; ++l) {
            const Real turns = kx * cx[l] + ky * cy[l] + kz * cz[l] + phase;
            const Real r = turns - nearestWhole(turns);
            const Real r2 = r * r;
            const Real wave = r * (w0 + r2 * (w1 + r2 * w2));
            gx[l] += sx * wave;
            gy[l] += sy * wave;
            gz[l] += sz * wave;
        }
    }
    Real *ax = block.air[0], *ay = block.air[1], *az = block.air[2];
    const Real inverse = waves.inverseLimitSquared;
    TAUT_INDEPENDENT
    for (int l = 0; l < count; ++l) {
        const Real squared = gx[l] * gx[l] + gy[l] * gy[l] + gz[l] * gz[l];
        const Real bend = Real(1) / root(Real(1) + squared * inverse);
        ax[l] += gx[l] * bend;
        ay[l] += gy[l] * bend;
        az[l] += gz[l] * bend;
    }
}

// With N = e1 × e2 = 2 A n and q = u·N the force ½ρA (C_D |u·n| u + C_L (u·n) (|u| n - (u·n)/|u| u)) is
//   ¼ρ (C_D |q| u + C_L (q/|N|) (|u| N - (q/|u|) u)).
// The smallest lengths added to |N| and |u| make 0/0 a 0: no area or no wind, no force.
template <class Real>
inline void findForces(const Corners<Real>& x, const Real* weight, Real drag, Real lift, int count,
                       Block<Real>& block) {
    const Real *xa = x.of[0][0], *ya = x.of[0][1], *za = x.of[0][2];
    const Real *xb = x.of[1][0], *yb = x.of[1][1], *zb = x.of[1][2];
    const Real *xc = x.of[2][0], *yc = x.of[2][1], *zc = x.of[2][2];
    const Real *ax = block.air[0], *ay = block.air[1], *az = block.air[2];
    Real *fx = block.force[0], *fy = block.force[1], *fz = block.force[2];
    const Real tiny = Real(1e-30);
    TAUT_INDEPENDENT
    for (int l = 0; l < count; ++l) {
        const Real e1x = xb[l] - xa[l], e1y = yb[l] - ya[l], e1z = zb[l] - za[l];
        const Real e2x = xc[l] - xa[l], e2y = yc[l] - ya[l], e2z = zc[l] - za[l];
        const Real nx = e1y * e2z - e1z * e2y, ny = e1z * e2x - e1x * e2z, nz = e1x * e2y - e1y * e2x;
        const Real ux = ax[l], uy = ay[l], uz = az[l];
        const Real q = ux * nx + uy * ny + uz * nz;
        const Real speed = root(ux * ux + uy * uy + uz * uz) + tiny;
        const Real size = root(nx * nx + ny * ny + nz * nz) + tiny;
        const Real s = lift * weight[l] * (q / size);
        const Real alongNormal = s * speed;
        const Real alongAir = drag * weight[l] * (q < Real(0) ? -q : q) - s * (q / speed);
        fx[l] = alongAir * ux + alongNormal * nx;
        fy[l] = alongAir * uy + alongNormal * ny;
        fz[l] = alongAir * uz + alongNormal * nz;
    }
}

template <class Real>
inline void findBlock(const WindBatch<Real>& batch, const Corners<Real>& x, const Corners<Real>& v, int lane, int count,
                      Block<Real>& block) {
    findRelativeAir(v, batch.flow, count, block);
    if (batch.gust != nullptr) addGust(x, *batch.gust, count, block);
    findForces(x, batch.weight + lane, batch.drag, batch.lift, count, block);
}

template <class Real>
void addRun(const WindBatch<Real>& batch, const CornerRun<3>& run) {
    Block<Real> block;
    for (int start = 0; start < run.count; start += kernelBlock) {
        const int count = run.count - start < kernelBlock ? run.count - start : kernelBlock;
        Corners<Real> x, v;
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                const long offset = static_cast<long>(axis) * batch.stride + run.first[corner] + start;
                x.of[corner][axis] = batch.x + offset;
                v.of[corner][axis] = batch.v + offset;
            }
        findBlock(batch, x, v, run.lane + start, count, block);
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                Real* f = batch.f + static_cast<long>(axis) * batch.stride + run.first[corner] + start;
                const Real* force = block.force[axis];
                TAUT_INDEPENDENT
                for (int l = 0; l < count; ++l) f[l] += force[l];
            }
    }
}

template <class Real>
void addLoose(const WindBatch<Real>& batch) {
    Block<Real> block;
    alignas(64) Real gathered[2][3][3][kernelBlock];
    Corners<Real> x, v;
    for (int corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis) {
            x.of[corner][axis] = gathered[0][corner][axis];
            v.of[corner][axis] = gathered[1][corner][axis];
        }
    const long stride = batch.stride;
    for (int start = 0; start < batch.lanes.looseCount; start += kernelBlock) {
        const int left = batch.lanes.looseCount - start;
        const int count = left < kernelBlock ? left : kernelBlock;
        for (int corner = 0; corner < 3; ++corner) {
            const int* points = batch.lanes.loose[corner] + start;
            for (int axis = 0; axis < 3; ++axis) {
                const Real *xs = batch.x + axis * stride, *vs = batch.v + axis * stride;
                Real *toX = gathered[0][corner][axis], *toV = gathered[1][corner][axis];
                for (int l = 0; l < count; ++l) toX[l] = xs[points[l]];
                for (int l = 0; l < count; ++l) toV[l] = vs[points[l]];
            }
        }
        findBlock(batch, x, v, batch.lanes.looseLane + start, count, block);
        // One triangle after the other: neighbours share points.
        for (int l = 0; l < count; ++l)
            for (int corner = 0; corner < 3; ++corner) {
                Real* f = batch.f + batch.lanes.loose[corner][start + l];
                f[0] += block.force[0][l];
                f[stride] += block.force[1][l];
                f[2 * stride] += block.force[2][l];
            }
    }
}

template <class Real>
void addAll(const WindBatch<Real>& batch) {
    for (int r = 0; r < batch.lanes.runCount; ++r) addRun(batch, batch.lanes.runs[r]);
    addLoose(batch);
}

}  // namespace

void addWind(const WindBatch<float>& batch) {
    addAll(batch);
}
void addWind(const WindBatch<double>& batch) {
    addAll(batch);
}

}  // namespace taut::mechanics::TAUT_ISA
