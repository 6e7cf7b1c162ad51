// Compiled once for each instruction set (engine/taut.cmake). It uses only + - * /, and no sum across lanes, so every
// width gives the same bits.
#include "taut/mechanics/private/volume_kernel.h"

#include "taut/core/private/vectorise.h"
#include "taut/mechanics/private/packed_points.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

// Planes of the four corners' positions: [corner][axis].
template <class Real>
struct Corners {
    const Real* of[4][3];
};

// The forces on corners 1, 2 and 3. The force on corner 0 is minus their sum.
template <class Real>
struct Forces {
    alignas(64) Real of[3][3][kernelBlock];  // [N]
};

// Edges e_i = p_i - p_0, 6 V = e1·(e2 × e3), 6 ∂V/∂p1 = e2 × e3 and cyclic, ∂V/∂p0 = -(the other three).
//   F_i = -K (V/V0 - 1) ∂V/∂p_i
template <class Real>
inline void findForces(const Corners<Real>& x, const Real* sixthOfBulk, const Real* inverseRestSixth, int count,
                       Forces<Real>& forces) {
    const Real *x0 = x.of[0][0], *y0 = x.of[0][1], *z0 = x.of[0][2];
    const Real *x1 = x.of[1][0], *y1 = x.of[1][1], *z1 = x.of[1][2];
    const Real *x2 = x.of[2][0], *y2 = x.of[2][1], *z2 = x.of[2][2];
    const Real *x3 = x.of[3][0], *y3 = x.of[3][1], *z3 = x.of[3][2];
    Real *fax = forces.of[0][0], *fay = forces.of[0][1], *faz = forces.of[0][2];
    Real *fbx = forces.of[1][0], *fby = forces.of[1][1], *fbz = forces.of[1][2];
    Real *fcx = forces.of[2][0], *fcy = forces.of[2][1], *fcz = forces.of[2][2];
    TAUT_INDEPENDENT
    for (int l = 0; l < count; ++l) {
        const Real ax = x1[l] - x0[l], ay = y1[l] - y0[l], az = z1[l] - z0[l];
        const Real bx = x2[l] - x0[l], by = y2[l] - y0[l], bz = z2[l] - z0[l];
        const Real cx = x3[l] - x0[l], cy = y3[l] - y0[l], cz = z3[l] - z0[l];
        const Real bcx = by * cz - bz * cy, bcy = bz * cx - bx * cz, bcz = bx * cy - by * cx;
        const Real cax = cy * az - cz * ay, cay = cz * ax - cx * az, caz = cx * ay - cy * ax;
        const Real abx = ay * bz - az * by, aby = az * bx - ax * bz, abz = ax * by - ay * bx;
        const Real sixfold = ax * bcx + ay * bcy + az * bcz;
        const Real push = sixthOfBulk[l] * (Real(1) - sixfold * inverseRestSixth[l]);
        fax[l] = push * bcx;
        fay[l] = push * bcy;
        faz[l] = push * bcz;
        fbx[l] = push * cax;
        fby[l] = push * cay;
        fbz[l] = push * caz;
        fcx[l] = push * abx;
        fcy[l] = push * aby;
        fcz[l] = push * abz;
    }
}

template <class Real>
void addRun(const VolumeBatch<Real>& batch, const CornerRun<4>& run) {
    Forces<Real> forces;
    for (int start = 0; start < run.count; start += kernelBlock) {
        const int count = run.count - start < kernelBlock ? run.count - start : kernelBlock;
        Corners<Real> x;
        for (int corner = 0; corner < 4; ++corner)
            for (int axis = 0; axis < 3; ++axis)
                x.of[corner][axis] = batch.x + static_cast<long>(axis) * batch.stride + run.first[corner] + start;
        const int lane = run.lane + start;
        findForces(x, batch.sixthOfBulk + lane, batch.inverseRestSixth + lane, count, forces);
        for (int axis = 0; axis < 3; ++axis) {
            Real* plane = batch.f + static_cast<long>(axis) * batch.stride + start;
            const Real *f1 = forces.of[0][axis], *f2 = forces.of[1][axis], *f3 = forces.of[2][axis];
            Real* f = plane + run.first[0];
            TAUT_INDEPENDENT
            for (int l = 0; l < count; ++l) f[l] -= f1[l] + f2[l] + f3[l];
            for (int corner = 1; corner < 4; ++corner) {
                Real* at = plane + run.first[corner];
                const Real* force = forces.of[corner - 1][axis];
                TAUT_INDEPENDENT
                for (int l = 0; l < count; ++l) at[l] += force[l];
            }
        }
    }
}

// Adds the loose tetrahedra. Each is moved so that corner 0 is the origin, which leaves the forces the same.
template <class Real>
void addLoose(const VolumeBatch<Real>& batch) {
    const CornerLanes<4>& lanes = batch.lanes;
    const int points = lanes.loosePointCount;
    Real *packed = batch.packed, *sums = packed + 4L * points;
    pack(batch.x, batch.stride, lanes.loosePoints, points, packed);
    __builtin_memset(sums, 0, sizeof(Real) * 4UL * static_cast<unsigned long>(points));

    Forces<Real> forces;
    alignas(64) Real zero[kernelBlock] = {}, edges[3][3][kernelBlock];
    Corners<Real> x;
    for (int axis = 0; axis < 3; ++axis) {
        x.of[0][axis] = zero;
        for (int edge = 0; edge < 3; ++edge) x.of[edge + 1][axis] = edges[edge][axis];
    }
    for (int start = 0; start < lanes.looseCount; start += kernelBlock) {
        const int count = lanes.looseCount - start < kernelBlock ? lanes.looseCount - start : kernelBlock;
        const int *p0 = lanes.loose[0] + start, *p1 = lanes.loose[1] + start, *p2 = lanes.loose[2] + start,
                  *p3 = lanes.loose[3] + start;
        // Gather the edges, four tetrahedra at a time.
        for (int l = 0; l < count; l += 4) {
            Four<Real> e1[4], e2[4], e3[4];
            for (int i = 0; i < 4; ++i) {
                const int t = l + i < count ? l + i : count - 1;
                Four<Real> origin;
                fetch(packed + 4L * p0[t], origin);
                fetch(packed + 4L * p1[t], e1[i]);
                e1[i] -= origin;
                fetch(packed + 4L * p2[t], e2[i]);
                e2[i] -= origin;
                fetch(packed + 4L * p3[t], e3[i]);
                e3[i] -= origin;
            }
            spread(e1, edges[0], l);
            spread(e2, edges[1], l);
            spread(e3, edges[2], l);
        }
        const int lane = lanes.looseLane + start;
        findForces(x, batch.sixthOfBulk + lane, batch.inverseRestSixth + lane, count, forces);
        // One tetrahedron after the other, because neighbours share points.
        for (int l = 0; l < count; l += 4) {
            Four<Real> f1[4], f2[4], f3[4];
            collect(forces.of[0], l, f1);
            collect(forces.of[1], l, f2);
            collect(forces.of[2], l, f3);
            for (int i = 0; i < 4 && l + i < count; ++i) {
                Real *at0 = sums + 4L * p0[l + i], *at1 = sums + 4L * p1[l + i], *at2 = sums + 4L * p2[l + i],
                     *at3 = sums + 4L * p3[l + i];
                addTo<Real>(at0, -(f1[i] + f2[i] + f3[i]));
                addTo(at1, f1[i]);
                addTo(at2, f2[i]);
                addTo(at3, f3[i]);
            }
        }
    }
    addPacked(sums, lanes.loosePoints, points, batch.f, batch.stride);
}

template <class Real>
void addAll(const VolumeBatch<Real>& batch) {
    for (int r = 0; r < batch.lanes.runCount; ++r) addRun(batch, batch.lanes.runs[r]);
    if (batch.lanes.looseCount > 0) addLoose(batch);
}

}  // namespace

void addVolume(const VolumeBatch<float>& batch) {
    addAll(batch);
}
void addVolume(const VolumeBatch<double>& batch) {
    addAll(batch);
}

}  // namespace taut::mechanics::TAUT_ISA
