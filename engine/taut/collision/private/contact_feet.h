// Where paths that end near triangles touch them, in loops over a batch: TriangleMesh::sweep for paths too short to
// cross the surface. It leaves all others. It is part of contact_kernel.cpp, compiled once for each instruction set.
#pragma once

#include "taut/collision/private/contact_response.h"
#include "taut/collision/private/foot_rows.h"
#include "taut/core/private/vectorise.h"

namespace taut::collision::TAUT_ISA {
namespace {

// Points that may be near the surface -> `near`. All others are known to be far.
template <class Real>
inline void findNear(const ContactArgs<Real>& s, ContactLanes& lanes) {
    const FootRows& rows = *s.feet.rows;
    const double thickness = s.thickness, skinPerMetre = s.skinPerMetre;
    const double(&to)[3][3] = s.to.rotation;
    const double(&from)[3][3] = s.from.rotation;
    const double tx = s.to.position[0], ty = s.to.position[1], tz = s.to.position[2];
    const double fx = s.from.position[0], fy = s.from.position[1], fz = s.from.position[2];
    const double(&anchor)[3][contactBatch] = rows.anchor;
    const unsigned* const masks = s.mask;
    TAUT_INDEPENDENT
    for (int i = 0; i < s.n; ++i) {
        const int at = s.feet.first + i;
        const double bx = static_cast<double>(s.before[0][i]);
        const double by = static_cast<double>(s.before[1][i]);
        const double bz = static_cast<double>(s.before[2][i]);
        const double x = static_cast<double>(s.x[0][i]) - tx;
        const double y = static_cast<double>(s.x[1][i]) - ty;
        const double z = static_cast<double>(s.x[2][i]) - tz;
        const double skin = skinPerMetre * (__builtin_fabs(bx) + __builtin_fabs(by) + __builtin_fabs(bz) + thickness);
        const double sx = bx - fx, sy = by - fy, sz = bz - fz;
        const double ex = to[0][0] * x + to[0][1] * y + to[0][2] * z;
        const double ey = to[1][0] * x + to[1][1] * y + to[1][2] * z;
        const double ez = to[2][0] * x + to[2][1] * y + to[2][2] * z;
        const double wx = ex - (from[0][0] * sx + from[0][1] * sy + from[0][2] * sz);
        const double wy = ey - (from[1][0] * sx + from[1][1] * sy + from[1][2] * sz);
        const double wz = ez - (from[2][0] * sx + from[2][1] * sy + from[2][2] * sz);
        const double ax = ex - anchor[0][at], ay = ey - anchor[1][at], az = ez - anchor[2][at];
        const double way = wx * wx + wy * wy + wz * wz;
        const double away = ax * ax + ay * ay + az * az;
        const double kept = thickness < 8.0 * skin ? 8.0 * skin : thickness;  // a mesh keeps at least that
        const bool isKnown = rows.finder[at] == s.feet.finder;
        // (a + b)² <= (1 + c) a² + (1 + 1/c) b²
        const double slack = rows.clear[at] - (kept + skin);
        const bool isFar = isKnown & (slack > 0.0) & (1.125 * away + 9.0 * way <= slack * slack);
        const bool isFree = static_cast<double>(s.inverseMass[i]) != 0.0;
        lanes.near[i] = (isFree & !isFar) ? 1 : 0;
    }
    if (masks == nullptr) return;
    TAUT_INDEPENDENT
    for (int i = 0; i < s.n; ++i) lanes.near[i] = masks[i] == s.bits ? lanes.near[i] : 0;
}

// Tells points whose foot is inside of a known triangle from the others, which are lost.
inline void recallFeet(const FeetArgs& feet, double thickness, ContactLanes& lanes, int n) {
    const FootRows& rows = *feet.rows;
    const double(&anchor)[3][contactBatch] = rows.anchor;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const int at = feet.first + i;
        const double x = lanes.localEnd[0][i], y = lanes.localEnd[1][i], z = lanes.localEnd[2][i];
        const double wx = x - lanes.localStart[0][i], wy = y - lanes.localStart[1][i], wz = z - lanes.localStart[2][i];
        const double ax = x - anchor[0][at], ay = y - anchor[1][at], az = z - anchor[2][at];
        const double away = ax * ax + ay * ay + az * az, radius = rows.radius[at];
        const bool isOver = (rows.finder[at] == feet.finder) & (radius > 0.0) & (away <= radius * radius);
        const bool isThin = thickness < 8.0 * lanes.skin[i];  // a mesh keeps more than the thickness
        const std::int64_t triangle = rows.triangle[at];
        const std::int64_t near = isOver ? isOverFace : isLost;
        lanes.way[i] = wx * wx + wy * wy + wz * wz;
        lanes.triangle[i] = isOver ? triangle : 0;
        lanes.outcome[i] = lanes.outcome[i] != 0 ? (isThin ? anyLeft : near) : 0;
    }
}

// The numbers of the triangles, unless they are there from the pass before.
inline void readFacets(const double* facets, ContactLanes& lanes, int n) {
    for (int i = 0; i < n; ++i) {
        const std::int64_t triangle = lanes.triangle[i];
        if (lanes.read[i] == triangle) continue;
        lanes.read[i] = triangle;
        for (int k = 0; k < 12; ++k) lanes.facet[k][i] = facets[12 * triangle + k];
    }
}

// The touch of each point that has a foot or whose foot is inside of a triangle -> `normal`, `distance` (the offset),
// in the frame of the triangles.
inline void touchFeet(const FeetArgs& feet, double thickness, ContactLanes& lanes, int n) {
    const bool isClosed = feet.isClosed;
    const double(&t)[12][contactRow] = lanes.facet;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double abx = t[3][i], aby = t[4][i], abz = t[5][i];
        const double acx = t[6][i], acy = t[7][i], acz = t[8][i];
        const double nx = t[9][i], ny = t[10][i], nz = t[11][i];
        const double x = lanes.localEnd[0][i], y = lanes.localEnd[1][i], z = lanes.localEnd[2][i];
        // nearestOnTriangle() of foot_finder.cpp, for places that get to its last line.
        const double apx = x - t[0][i], apy = y - t[1][i], apz = z - t[2][i];
        const double d1 = abx * apx + aby * apy + abz * apz;
        const double d2 = acx * apx + acy * apy + acz * apz;
        const double bpx = apx - abx, bpy = apy - aby, bpz = apz - abz;
        const double d3 = abx * bpx + aby * bpy + abz * bpz;
        const double d4 = acx * bpx + acy * bpy + acz * bpz;
        const double vc = d1 * d4 - d3 * d2;
        const double cpx = apx - acx, cpy = apy - acy, cpz = apz - acz;
        const double d5 = abx * cpx + aby * cpy + abz * cpz;
        const double d6 = acx * cpx + acy * cpy + acz * cpz;
        const double vb = d5 * d2 - d1 * d6;
        const double va = d3 * d6 - d5 * d4;
        const bool isAtCorner = ((d1 <= 0.0) & (d2 <= 0.0)) | ((d3 >= 0.0) & (d4 <= d3)) | ((d6 >= 0.0) & (d5 <= d6));
        const bool isAtEdge = (va <= 0.0) | (vb <= 0.0) | (vc <= 0.0);
        const double whole = 1.0 / (va + vb + vc);
        const double b = vb * whole, c = vc * whole;
        const std::int64_t found = lanes.outcome[i];
        const bool isFound = found == hasFoot;
        const double qx = isFound ? lanes.foot[0][i] : t[0][i] + abx * b + acx * c;
        const double qy = isFound ? lanes.foot[1][i] : t[1][i] + aby * b + acy * c;
        const double qz = isFound ? lanes.foot[2][i] : t[2][i] + abz * b + acz * c;
        const bool isFoot = isFound | !(isAtCorner | isAtEdge);

        // A path shorter than the way to the surface crosses nothing: see `clear` in TriangleMesh::sweep. Here it is
        // without a root: (a + b)² <= 2 a² + 2 b².
        const double skin = lanes.skin[i], reach = thickness + skin;
        const double px = x - qx, py = y - qy, pz = z - qz;
        const double square = px * px + py * py + pz * pz;
        const double facing = px * nx + py * ny + pz * nz;
        const bool isShort = square > 2.000001 * (lanes.way[i] + skin * skin);
        const bool isPlain = isFoot & isShort & !(isClosed & (facing < 0.0));
        const double side = facing > 0.0 ? 1.0 : -1.0;
        const double upX = side * nx, upY = side * ny, upZ = side * nz;
        const bool isFlat = square - facing * facing <= skin * skin;
        const std::int64_t near = square < reach * reach ? isNear : 0;
        lanes.foot[0][i] = qx;
        lanes.foot[1][i] = qy;
        lanes.foot[2][i] = qz;
        lanes.normal[0][i] = upX;
        lanes.normal[1][i] = upY;
        lanes.normal[2][i] = upZ;
        lanes.distance[i] = upX * qx + upY * qy + upZ * qz + thickness;
        lanes.outcome[i] = (found & (hasFoot | isOverFace)) != 0 ? (isPlain ? near : anyLeft) : found;
        lanes.bent[i] = isFlat ? 0 : lanes.outcome[i];
    }
    // Not over the middle of a triangle.
    for (int i = 0; i < n; ++i) {
        if (lanes.bent[i] != isNear) continue;
        const double qx = lanes.foot[0][i], qy = lanes.foot[1][i], qz = lanes.foot[2][i];
        const double px = lanes.localEnd[0][i] - qx, py = lanes.localEnd[1][i] - qy, pz = lanes.localEnd[2][i] - qz;
        const double scale = 1.0 / __builtin_sqrt(px * px + py * py + pz * pz);
        const double normalX = px * scale, normalY = py * scale, normalZ = pz * scale;
        lanes.normal[0][i] = normalX;
        lanes.normal[1][i] = normalY;
        lanes.normal[2][i] = normalZ;
        lanes.distance[i] = normalX * qx + normalY * qy + normalZ * qz + thickness;
    }
}

// Adds the touches of a pass to the records, from `at` on.
inline void recordTouches(ContactLanes& lanes, int at, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double impulse = lanes.outcome[i] == anyTouched ? lanes.impulse[i] : 0.0;
        lanes.sum[at + i] += impulse;
    }
    for (int k = 0; k < 3; ++k) {
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) {
            const std::int64_t mask = lanes.outcome[i] == anyTouched ? -1 : 0;
            lanes.last[k][at + i] = select(mask, lanes.position[k][i], lanes.last[k][at + i]);
            lanes.last[3 + k][at + i] = select(mask, lanes.normal[k][i], lanes.last[3 + k][at + i]);
            lanes.last[6 + k][at + i] = select(mask, lanes.carried[k][i], lanes.last[6 + k][at + i]);
        }
    }
}

// Puts the records where the caller looks for them.
inline void showRecords(ContactLanes& lanes, int n) {
    for (int i = 0; i < n; ++i) lanes.impulse[i] = lanes.sum[i];
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < n; ++i) {
            lanes.position[k][i] = lanes.last[k][i];
            lanes.normal[k][i] = lanes.last[3 + k][i];
            lanes.carried[k][i] = lanes.last[6 + k][i];
        }
}

// Adds the outcomes of a pass to `result`, from `at` on. The points that it moved are tried again; false: there are
// none.
inline bool addResults(ContactLanes& lanes, int at, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const std::int64_t found = lanes.outcome[i], before = lanes.result[at + i];
        lanes.result[at + i] = found != 0 ? found : before;
        lanes.outcome[i] = ((found == anyTouched) & (lanes.isMoved[i] != 0)) ? isLive : 0;
    }
    return anyOf(lanes.outcome, n) != 0;
}

}  // namespace
}  // namespace taut::collision::TAUT_ISA
