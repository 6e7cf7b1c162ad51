// Compiled once for each instruction set (engine/taut.cmake). It uses only + - * /, and no sum across lanes, so every
// width gives the same bits.
#include "taut/mechanics/private/volume_kernel.h"

#include "taut/core/private/vectorise.h"
#include "taut/mechanics/private/packed_points.h"

namespace taut::mechanics::TAUT_ISA {
namespace {

// Planes of the eight corners' positions: [corner][axis].
template <class Real>
struct CellCorners {
    const Real* of[8][3];
};

// The forces on the corners, and the least volume of a tetrahedron of the cell.
template <class Real>
struct Forces {
    alignas(64) Real of[8][3][kernelBlock];  // [N]
    alignas(64) Real leastSixfold[kernelBlock];
};

template <class Real>
struct Triple {
    Real x, y, z;
};
template <class Real>
inline Triple<Real> operator+(const Triple<Real>& u, const Triple<Real>& v) {
    return {u.x + v.x, u.y + v.y, u.z + v.z};
}
template <class Real>
inline Triple<Real> operator-(const Triple<Real>& u, const Triple<Real>& v) {
    return {u.x - v.x, u.y - v.y, u.z - v.z};
}
template <class Real>
inline Triple<Real> operator*(Real s, const Triple<Real>& u) {
    return {s * u.x, s * u.y, s * u.z};
}
template <class Real>
inline Triple<Real> cross(const Triple<Real>& u, const Triple<Real>& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
template <class Real>
inline Real dot(const Triple<Real>& u, const Triple<Real>& v) {
    return u.x * v.x + u.y * v.y + u.z * v.z;
}
template <class Real>
inline Triple<Real> at(const Real* const (&of)[3], int l) {
    return {of[0][l], of[1][l], of[2][l]};
}
template <class Real>
inline void store(const Triple<Real>& u, int l, Real (&of)[3][kernelBlock]) {
    of[0][l] = u.x;
    of[1][l] = u.y;
    of[2][l] = u.z;
}

// F_i = -K (V/V0 - 1) ∂V/∂p_i, with the volume of cell_shape.h:
//   12 V = (a + a')·(b × c) + a·((b + b') × c') + a'·(b' × (c + c')).
// Each of a, a', b, b', c, c' ends at corner 0 or 7, and at one of the others. So the derivatives by them are the
// forces on the others, and their sums those on 0 and 7.
template <class Real>
inline void findPressure(const CellCorners<Real>& x, const Real* twelfthOfBulk, const Real* inverseRestTwelvefold,
                         int count, Forces<Real>& forces) {
    TAUT_INDEPENDENT
    for (int l = 0; l < count; ++l) {
        const Triple<Real> p0 = at(x.of[0], l), p7 = at(x.of[7], l);
        const Triple<Real> a = at(x.of[6], l) - p0, a1 = p7 - at(x.of[1], l);
        const Triple<Real> b = p7 - at(x.of[2], l), b1 = at(x.of[5], l) - p0;
        const Triple<Real> c = at(x.of[3], l) - p0, c1 = p7 - at(x.of[4], l);
        const Triple<Real> bc = cross(b, c), ca = cross(c1, a), ab = cross(a1, b1);
        const Triple<Real> ofA = bc + cross(b + b1, c1), ofA1 = bc + cross(b1, c + c1);
        const Real twelvefold = dot(a, ofA) + dot(a1, ofA1);
        const Real push = twelfthOfBulk[l] * (Real(1) - twelvefold * inverseRestTwelvefold[l]);
        const Triple<Real> f6 = push * ofA, f1 = push * ofA1;
        const Triple<Real> f2 = push * (ca + cross(c, a + a1)), f5 = push * (ca + cross(c + c1, a1));
        const Triple<Real> f3 = push * (ab + cross(a + a1, b)), f4 = push * (ab + cross(a, b + b1));
        const Triple<Real> zero{Real(0), Real(0), Real(0)};
        store(zero - (f6 + f5 + f3), l, forces.of[0]);
        store(zero - f1, l, forces.of[1]);
        store(zero - f2, l, forces.of[2]);
        store(f3, l, forces.of[3]);
        store(zero - f4, l, forces.of[4]);
        store(f5, l, forces.of[5]);
        store(f6, l, forces.of[6]);
        store(f1 + f2 + f4, l, forces.of[7]);
    }
}

// The corners around the diagonal from 0 to 7: with it, two that are next to each other make a tetrahedron.
constexpr int around[7] = {1, 3, 2, 6, 4, 5, 1};

template <class Real>
inline void findLeast(const CellCorners<Real>& x, int count, Forces<Real>& forces) {
    TAUT_INDEPENDENT
    for (int l = 0; l < count; ++l) {
        const Triple<Real> p0 = at(x.of[0], l), d = at(x.of[7], l) - p0;
        const Triple<Real> q1 = at(x.of[1], l) - p0, q3 = at(x.of[3], l) - p0, q2 = at(x.of[2], l) - p0,
                           q6 = at(x.of[6], l) - p0, q4 = at(x.of[4], l) - p0, q5 = at(x.of[5], l) - p0;
        // d·(q_i × q_k) = q_k·(d × q_i)
        const Triple<Real> n1 = cross(d, q1), n2 = cross(d, q2), n4 = cross(d, q4);
        const Real v13 = dot(q3, n1), v51 = Real(0) - dot(q5, n1), v32 = Real(0) - dot(q3, n2), v26 = dot(q6, n2),
                   v64 = Real(0) - dot(q6, n4), v45 = dot(q5, n4);
        Real least = v13 < v51 ? v13 : v51;
        least = v32 < least ? v32 : least;
        least = v26 < least ? v26 : least;
        least = v64 < least ? v64 : least;
        forces.leastSixfold[l] = v45 < least ? v45 : least;
    }
}

// F_i = -K (V_t/V0_t) ∂V_t/∂p_i of each tetrahedron of the cell in lane l that is turned inside out.
template <class Real>
inline void addFolds(const CellCorners<Real>& x, Real twelfthOfBulk, Real inverseRestTwelvefold, int l,
                     Forces<Real>& forces) {
    const Triple<Real> p0 = at(x.of[0], l), d = at(x.of[7], l) - p0;
    for (int k = 0; k < 6; ++k) {
        const int i = around[k], j = around[k + 1];
        const Triple<Real> a = at(x.of[i], l) - p0, b = at(x.of[j], l) - p0, ab = cross(a, b);
        const Real sixfold = dot(d, ab);
        if (!(sixfold < Real(0))) continue;
        const Real push = Real(-24) * twelfthOfBulk * sixfold * inverseRestTwelvefold;  // -K/6 · V_t/V0_t
        const Triple<Real> fa = push * cross(b, d), fb = push * cross(d, a), fd = push * ab, f0 = fa + fb + fd;
        const auto add = [&](const Triple<Real>& f, Real(&of)[3][kernelBlock]) {
            store(Triple<Real>{of[0][l], of[1][l], of[2][l]} + f, l, of);
        };
        add(fa, forces.of[i]);
        add(fb, forces.of[j]);
        add(fd, forces.of[7]);
        add(Triple<Real>{Real(0), Real(0), Real(0)} - f0, forces.of[0]);
    }
}

template <class Real>
inline void findForces(const CellCorners<Real>& x, const Real* twelfthOfBulk, const Real* inverseRestTwelvefold,
                       int count, Forces<Real>& forces) {
    findPressure(x, twelfthOfBulk, inverseRestTwelvefold, count, forces);
    findLeast(x, count, forces);
    for (int l = 0; l < count; ++l)
        if (forces.leastSixfold[l] < Real(0)) addFolds(x, twelfthOfBulk[l], inverseRestTwelvefold[l], l, forces);
}

template <class Real>
void addRun(const VolumeBatch<Real>& batch, const CornerRun<8>& run) {
    Forces<Real> forces;
    for (int start = 0; start < run.count; start += kernelBlock) {
        const int count = run.count - start < kernelBlock ? run.count - start : kernelBlock;
        CellCorners<Real> x;
        for (int corner = 0; corner < 8; ++corner)
            for (int axis = 0; axis < 3; ++axis)
                x.of[corner][axis] = batch.x + static_cast<long>(axis) * batch.stride + run.first[corner] + start;
        const int lane = run.lane + start;
        findForces(x, batch.twelfthOfBulk + lane, batch.inverseRestTwelvefold + lane, count, forces);
        for (int axis = 0; axis < 3; ++axis)
            for (int corner = 0; corner < 8; ++corner) {
                Real* f = batch.f + static_cast<long>(axis) * batch.stride + run.first[corner] + start;
                const Real* force = forces.of[corner][axis];
                TAUT_INDEPENDENT
                for (int l = 0; l < count; ++l) f[l] += force[l];
            }
    }
}

// Adds the loose cells.
template <class Real>
void addLoose(const VolumeBatch<Real>& batch) {
    const CornerLanes<8>& lanes = batch.lanes;
    const int points = lanes.loosePointCount;
    Real *packed = batch.packed, *sums = packed + 4L * points;
    pack(batch.x, batch.stride, lanes.loosePoints, points, packed);
    __builtin_memset(sums, 0, sizeof(Real) * 4UL * static_cast<unsigned long>(points));

    Forces<Real> forces;
    alignas(64) Real places[8][3][kernelBlock];
    CellCorners<Real> x;
    for (int corner = 0; corner < 8; ++corner)
        for (int axis = 0; axis < 3; ++axis) x.of[corner][axis] = places[corner][axis];
    for (int start = 0; start < lanes.looseCount; start += kernelBlock) {
        const int count = lanes.looseCount - start < kernelBlock ? lanes.looseCount - start : kernelBlock;
        // Gather the corners, four cells at a time.
        for (int l = 0; l < count; l += 4)
            for (int corner = 0; corner < 8; ++corner) {
                const int* p = lanes.loose[corner] + start;
                Four<Real> of[4];
                for (int i = 0; i < 4; ++i) fetch(packed + 4L * p[l + i < count ? l + i : count - 1], of[i]);
                spread(of, places[corner], l);
            }
        const int lane = lanes.looseLane + start;
        findForces(x, batch.twelfthOfBulk + lane, batch.inverseRestTwelvefold + lane, count, forces);
        // One cell after the other, because neighbours share points.
        for (int l = 0; l < count; l += 4) {
            Four<Real> f[8][4];
            for (int corner = 0; corner < 8; ++corner) collect(forces.of[corner], l, f[corner]);
            for (int i = 0; i < 4 && l + i < count; ++i)
                for (int corner = 0; corner < 8; ++corner)
                    addTo<Real>(sums + 4L * lanes.loose[corner][start + l + i], f[corner][i]);
        }
    }
    addPacked(sums, lanes.loosePoints, points, batch.f, batch.stride);
}

}  // namespace

template <class Real>
void addVolume(const VolumeBatch<Real>& batch) {
    for (int r = 0; r < batch.lanes.runCount; ++r) addRun(batch, batch.lanes.runs[r]);
    if (batch.lanes.looseCount > 0) addLoose(batch);
}
template void addVolume(const VolumeBatch<float>&);
template void addVolume(const VolumeBatch<double>&);

}  // namespace taut::mechanics::TAUT_ISA
