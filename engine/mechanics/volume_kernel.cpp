// Compiled once per instruction set (engine/taut.cmake). Only + - * /, no sum across lanes: the same bits for every
// width.
#include "taut/mechanics/volume_kernel.h"

#include "taut/core/vectorise.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

// Planes of the four corners' positions: [corner][axis].
template <class Real>
struct Corners {
    const Real* of[4][3];
};

template <class Real>
struct Forces {
    alignas(64) Real of[4][3][kernelBlock];  // [N]
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
        const Real f1x = push * bcx, f1y = push * bcy, f1z = push * bcz;
        const Real f2x = push * cax, f2y = push * cay, f2z = push * caz;
        const Real f3x = push * abx, f3y = push * aby, f3z = push * abz;
        forces.of[0][0][l] = -(f1x + f2x + f3x);
        forces.of[0][1][l] = -(f1y + f2y + f3y);
        forces.of[0][2][l] = -(f1z + f2z + f3z);
        forces.of[1][0][l] = f1x;
        forces.of[1][1][l] = f1y;
        forces.of[1][2][l] = f1z;
        forces.of[2][0][l] = f2x;
        forces.of[2][1][l] = f2y;
        forces.of[2][2][l] = f2z;
        forces.of[3][0][l] = f3x;
        forces.of[3][1][l] = f3y;
        forces.of[3][2][l] = f3z;
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
        for (int corner = 0; corner < 4; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                Real* f = batch.f + static_cast<long>(axis) * batch.stride + run.first[corner] + start;
                const Real* force = forces.of[corner][axis];
                TAUT_INDEPENDENT
                for (int l = 0; l < count; ++l) f[l] += force[l];
            }
    }
}

template <class Real>
void addLoose(const VolumeBatch<Real>& batch) {
    Forces<Real> forces;
    alignas(64) Real gathered[4][3][kernelBlock];
    Corners<Real> x;
    for (int corner = 0; corner < 4; ++corner)
        for (int axis = 0; axis < 3; ++axis) x.of[corner][axis] = gathered[corner][axis];
    const long stride = batch.stride;
    for (int start = 0; start < batch.lanes.looseCount; start += kernelBlock) {
        const int left = batch.lanes.looseCount - start;
        const int count = left < kernelBlock ? left : kernelBlock;
        for (int corner = 0; corner < 4; ++corner) {
            const int* points = batch.lanes.loose[corner] + start;
            for (int axis = 0; axis < 3; ++axis) {
                const Real* from = batch.x + axis * stride;
                Real* to = gathered[corner][axis];
                for (int l = 0; l < count; ++l) to[l] = from[points[l]];
            }
        }
        const int lane = batch.lanes.looseLane + start;
        findForces(x, batch.sixthOfBulk + lane, batch.inverseRestSixth + lane, count, forces);
        // One tetrahedron after the other: neighbours share points.
        for (int l = 0; l < count; ++l)
            for (int corner = 0; corner < 4; ++corner) {
                Real* f = batch.f + batch.lanes.loose[corner][start + l];
                f[0] += forces.of[corner][0][l];
                f[stride] += forces.of[corner][1][l];
                f[2 * stride] += forces.of[corner][2][l];
            }
    }
}

template <class Real>
void addAll(const VolumeBatch<Real>& batch) {
    for (int r = 0; r < batch.lanes.runCount; ++r) addRun(batch, batch.lanes.runs[r]);
    addLoose(batch);
}

}  // namespace

void addVolume(const VolumeBatch<float>& batch) {
    addAll(batch);
}
void addVolume(const VolumeBatch<double>& batch) {
    addAll(batch);
}

}  // namespace taut::mechanics::TAUT_ISA
