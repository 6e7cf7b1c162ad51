// Compiled once for each instruction set (engine/taut.cmake). It uses only + - * / and square roots, and no sum across
// lanes, so every width gives the same bits.
#include "taut/mechanics/private/wind_kernel.h"

#include "taut/core/private/vectorise.h"
#include "taut/mechanics/private/packed_points.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

using core::TAUT_ISA::root;

// Adding and subtracting 1.5 · 2^23 (2^52) rounds to the nearest whole number.
inline float nearestWhole(float x) {
    return (x + 12582912.0F) - 12582912.0F;
}
inline double nearestWhole(double x) {
    return (x + 6755399441055744.0) - 6755399441055744.0;
}

template <class Real>
struct Block {
    alignas(64) Real air[3][kernelBlock];    // air relative to the triangle [m/s]
    alignas(64) Real force[3][kernelBlock];  // a third of the triangle's force [N]
};

// Planes of a vector at the three corners: [corner][axis].
template <class Real>
struct TriangleCorners {
    const Real* of[3][3];
};

// Computes the velocities of the points less the gust there. The gust is the waves' sum g, bent to g/√(1 + g²/limit²).
template <class Real>
inline void findSlip(const WindBatch<Real>& batch) {
    const GustWaves<Real>& waves = *batch.gust;
    const Real w0 = Real(gustWaveShape[0]), w1 = Real(gustWaveShape[1]), w2 = Real(gustWaveShape[2]);
    const Real inverse = waves.inverseLimitSquared;
    alignas(64) Real gust[3][kernelBlock];
    Real *gx = gust[0], *gy = gust[1], *gz = gust[2];
    for (int start = 0; start < batch.pointCount; start += kernelBlock) {
        const int count = batch.pointCount - start < kernelBlock ? batch.pointCount - start : kernelBlock;
        const long stride = batch.stride;
        const Real *x = batch.x + batch.firstPoint + start, *y = x + stride, *z = y + stride;
        for (int l = 0; l < kernelBlock; ++l) gx[l] = gy[l] = gz[l] = Real(0);
        for (int w = 0; w < gustWaveCount; ++w) {
            const Real kx = waves.wavenumber[0][w], ky = waves.wavenumber[1][w], kz = waves.wavenumber[2][w];
            const Real sx = waves.strength[0][w], sy = waves.strength[1][w], sz = waves.strength[2][w];
            const Real phase = waves.phase[w];
            TAUT_INDEPENDENT
            for (int l = 0; l < count; ++l) {
                const Real turns = kx * x[l] + ky * y[l] + kz * z[l] + phase;
                const Real r = turns - nearestWhole(turns);
                const Real r2 = r * r;
                const Real wave = r * (w0 + r2 * (w1 + r2 * w2));
                gx[l] += sx * wave;
                gy[l] += sy * wave;
                gz[l] += sz * wave;
            }
        }
        const Real *vx = batch.v + batch.firstPoint + start, *vy = vx + stride, *vz = vy + stride;
        Real *ux = batch.slip + start, *uy = ux + batch.pointCount, *uz = uy + batch.pointCount;
        TAUT_INDEPENDENT
        for (int l = 0; l < count; ++l) {
            const Real squared = gx[l] * gx[l] + gy[l] * gy[l] + gz[l] * gz[l];
            const Real bend = Real(1) / root(Real(1) + squared * inverse);
            ux[l] = vx[l] - gx[l] * bend;
            uy[l] = vy[l] - gy[l] * bend;
            uz[l] = vz[l] - gz[l] * bend;
        }
    }
}

template <class Real>
inline void findRelativeAir(const TriangleCorners<Real>& slip, const Real* flow, int count, Block<Real>& block) {
    const Real third = Real(1.0 / 3.0);
    for (int axis = 0; axis < 3; ++axis) {
        const Real *a = slip.of[0][axis], *b = slip.of[1][axis], *c = slip.of[2][axis];
        const Real steady = flow[axis];
        Real* air = block.air[axis];
        TAUT_INDEPENDENT
        for (int l = 0; l < count; ++l) air[l] = steady - (a[l] + b[l] + c[l]) * third;
    }
}

// With N = e1 × e2 = 2 A n, q = u·N and c = q/(|u||N|) the force ½ρA (C_D |u·n| u + C_L (u·n) (|u| n - (u·n)/|u| u)) is
//   ¼ρ (C_D |q| u + C_L c (|u|² N - q u)).
// A tiny number added to |u||N| makes 0/0 a 0: without area or wind there is no force.
template <class Real>
inline void findForces(const TriangleCorners<Real>& x, const Real* weight, Real drag, Real lift, int count,
                       Block<Real>& block) {
    const Real *xa = x.of[0][0], *ya = x.of[0][1], *za = x.of[0][2];
    const Real *xb = x.of[1][0], *yb = x.of[1][1], *zb = x.of[1][2];
    const Real *xc = x.of[2][0], *yc = x.of[2][1], *zc = x.of[2][2];
    const Real *ax = block.air[0], *ay = block.air[1], *az = block.air[2];
    Real *fx = block.force[0], *fy = block.force[1], *fz = block.force[2];
    const Real tiny = Real(1e-18);
    TAUT_INDEPENDENT
    for (int l = 0; l < count; ++l) {
        const Real e1x = xb[l] - xa[l], e1y = yb[l] - ya[l], e1z = zb[l] - za[l];
        const Real e2x = xc[l] - xa[l], e2y = yc[l] - ya[l], e2z = zc[l] - za[l];
        const Real nx = e1y * e2z - e1z * e2y, ny = e1z * e2x - e1x * e2z, nz = e1x * e2y - e1y * e2x;
        const Real ux = ax[l], uy = ay[l], uz = az[l];
        const Real q = ux * nx + uy * ny + uz * nz;
        const Real speed2 = ux * ux + uy * uy + uz * uz, size2 = nx * nx + ny * ny + nz * nz;
        const Real share = weight[l] * q / (root(speed2 * size2) + tiny);
        const Real alongNormal = lift * share * speed2;
        const Real alongAir = drag * weight[l] * (q < Real(0) ? -q : q) - lift * share * q;
        fx[l] = alongAir * ux + alongNormal * nx;
        fy[l] = alongAir * uy + alongNormal * ny;
        fz[l] = alongAir * uz + alongNormal * nz;
    }
}

template <class Real>
inline void findBlock(const WindBatch<Real>& batch, const TriangleCorners<Real>& x, const TriangleCorners<Real>& slip,
                      int lane, int count, Block<Real>& block) {
    findRelativeAir(slip, batch.flow, count, block);
    findForces(x, batch.weight + lane, batch.drag, batch.lift, count, block);
}

// Planes that begin at point 0.
template <class Real>
struct Planes {
    const Real* data;
    long stride;
};

template <class Real>
void addRun(const WindBatch<Real>& batch, const Planes<Real>& slip, const CornerRun<3>& run) {
    Block<Real> block;
    for (int start = 0; start < run.count; start += kernelBlock) {
        const int count = run.count - start < kernelBlock ? run.count - start : kernelBlock;
        TriangleCorners<Real> x, u;
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                const long first = run.first[corner] + start;
                x.of[corner][axis] = batch.x + axis * static_cast<long>(batch.stride) + first;
                u.of[corner][axis] = slip.data + axis * slip.stride + first;
            }
        findBlock(batch, x, u, run.lane + start, count, block);
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                Real* f = batch.f + static_cast<long>(axis) * batch.stride + run.first[corner] + start;
                const Real* force = block.force[axis];
                TAUT_INDEPENDENT
                for (int l = 0; l < count; ++l) f[l] += force[l];
            }
    }
}

// Adds the loose triangles. Each is moved so that corner a is the origin, and corner a gets the sum of all slips. The
// forces stay the same.
template <class Real>
void addLoose(const WindBatch<Real>& batch, const Planes<Real>& slip) {
    const CornerLanes<3>& lanes = batch.lanes;
    const int points = lanes.loosePointCount;
    Real *packed = batch.packed, *forces = packed + 8L * points;
    pack(batch.x, batch.stride, lanes.loosePoints, points, packed, 2);
    pack(slip.data, slip.stride, lanes.loosePoints, points, packed + 4, 2);
    __builtin_memset(forces, 0, sizeof(Real) * 4UL * static_cast<unsigned long>(points));

    Block<Real> block;
    alignas(64) Real zero[kernelBlock] = {}, b[3][kernelBlock], c[3][kernelBlock], sum[3][kernelBlock];
    TriangleCorners<Real> x, u;
    for (int axis = 0; axis < 3; ++axis) {
        x.of[0][axis] = u.of[1][axis] = u.of[2][axis] = zero;
        x.of[1][axis] = b[axis];
        x.of[2][axis] = c[axis];
        u.of[0][axis] = sum[axis];
    }
    // Block by block: gather the corners, compute all forces, add them triangle by triangle.
    for (int start = 0; start < lanes.looseCount; start += kernelBlock) {
        const int count = lanes.looseCount - start < kernelBlock ? lanes.looseCount - start : kernelBlock;
        const int *pa = lanes.loose[0] + start, *pb = lanes.loose[1] + start, *pc = lanes.loose[2] + start;
        for (int l = 0; l < count; l += 4) {
            Four<Real> e1[4], e2[4], slips[4];
            for (int i = 0; i < 4; ++i) {
                const int t = l + i < count ? l + i : count - 1;
                const Real *atA = packed + 8L * pa[t], *atB = packed + 8L * pb[t], *atC = packed + 8L * pc[t];
                Four<Real> origin;
                fetch(atA, origin);
                fetch(atB, e1[i]);
                e1[i] -= origin;
                fetch(atC, e2[i]);
                e2[i] -= origin;
                Four<Real> slipB, slipC;
                fetch(atA + 4, slips[i]);
                fetch(atB + 4, slipB);
                fetch(atC + 4, slipC);
                slips[i] = slips[i] + slipB + slipC;
            }
            spread(e1, b, l);
            spread(e2, c, l);
            spread(slips, sum, l);
        }
        findBlock(batch, x, u, lanes.looseLane + start, count, block);
        // One triangle after the other, because neighbours share points.
        for (int l = 0; l < count; l += 4) {
            Four<Real> force[4];
            collect(block.force, l, force);
            for (int i = 0; i < 4 && l + i < count; ++i)
                for (int corner = 0; corner < 3; ++corner)
                    addTo(forces + 4L * lanes.loose[corner][start + l + i], force[i]);
        }
    }
    addPacked(forces, lanes.loosePoints, points, batch.f, batch.stride);
}

}  // namespace

template <class Real>
void addWind(const WindBatch<Real>& batch) {
    Planes<Real> slip{batch.v, batch.stride};
    if (batch.gust != nullptr) {
        findSlip(batch);
        slip = {batch.slip - batch.firstPoint, batch.pointCount};
    }
    for (int r = 0; r < batch.lanes.runCount; ++r) addRun(batch, slip, batch.lanes.runs[r]);
    if (batch.lanes.looseCount > 0) addLoose(batch, slip);
}
template void addWind(const WindBatch<float>&);
template void addWind(const WindBatch<double>&);

}  // namespace taut::mechanics::TAUT_ISA
