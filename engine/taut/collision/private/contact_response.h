// The response to a touch, in loops over a batch. It is part of contact_kernel.cpp, compiled once for each instruction
// set.
#pragma once

#include "taut/collision/private/contact_kernel.h"
#include "taut/core/private/vectorise.h"
#include "taut/core/private/vectors.h"

namespace taut::collision::TAUT_ISA {
namespace {

using core::TAUT_ISA::select;
using Row = double[contactRow];
using Rows = Row[3];

// A loop of its own: inside the loops that set `outcome` it would keep compilers from vectorising them.
inline long anyOf(const long (&outcome)[contactRow], int n) {
    long any = 0;
    for (int i = 0; i < n; ++i) any |= outcome[i];
    return any;
}

// respond() of response.h, cut where one condition would depend on another: compilers vectorise each of these loops,
// but not all of them as one. `velocity` is the surface's.
// press() computes what the normal impulse and friction would do to each point. `path` is the start of the path,
// carried along by the surface.
template <bool still>
inline void press(double friction, double restitution, double restSpeed, const Rows& path, const Rows& velocity,
                  ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double nx = lanes.normal[0][i], ny = lanes.normal[1][i], nz = lanes.normal[2][i];
        const double ux = still ? lanes.v[0][i] : lanes.v[0][i] - velocity[0][i];
        const double uy = still ? lanes.v[1][i] : lanes.v[1][i] - velocity[1][i];
        const double uz = still ? lanes.v[2][i] : lanes.v[2][i] - velocity[2][i];
        const double un = ux * nx + uy * ny + uz * nz;
        const double bounce = un < -restSpeed ? restitution : 0.0;
        const double push = -(1.0 + bounce) * un;
        const double impulse = un < 0.0 ? push : 0.0;
        const double sx = ux - un * nx, sy = uy - un * ny, sz = uz - un * nz;
        const double slideSquare = sx * sx + sy * sy + sz * sz;
        const double grip = friction * impulse;

        // Position: the way relative to the surface, and the part of it along the surface after the touch.
        const double x = lanes.end[0][i], y = lanes.end[1][i], z = lanes.end[2][i];
        const double wx = x - path[0][i], wy = y - path[1][i], wz = z - path[2][i];
        const double depth = lanes.distance[i] - (nx * x + ny * y + nz * z);
        const double fall = -(wx * nx + wy * ny + wz * nz);
        const double deep = depth + lanes.skin[i];
        const double least = deep < fall ? deep : fall;
        const double pressed = least > 0.0 ? least : 0.0;
        const double share = pressed / fall;
        const double ax = (wx + fall * nx) * share, ay = (wy + fall * ny) * share, az = (wz + fall * nz) * share;
        const double square = ax * ax + ay * ay + az * az;
        const double limit = friction * pressed * (1.0 + bounce);

        lanes.depth[i] = depth;
        lanes.approach[i] = un;
        lanes.bounce[i] = bounce;
        lanes.impulse[i] = impulse;
        lanes.slide[0][i] = sx;
        lanes.slide[1][i] = sy;
        lanes.slide[2][i] = sz;
        lanes.slideSquare[i] = slideSquare;
        lanes.grip[i] = grip;
        lanes.pressed[i] = pressed;
        lanes.along[0][i] = ax;
        lanes.along[1][i] = ay;
        lanes.along[2][i] = az;
        lanes.square[i] = square;
        lanes.back[i] = limit;
        const long found = lanes.outcome[i];
        lanes.slips[i] = slideSquare <= grip * grip ? 0L : found;  // friction does not stop it
        lanes.creeps[i] = square <= limit * limit ? 0L : found;    // friction does not undo all of its way
    }
}

// The share of the sliding that friction takes.
inline void findGrips(ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double grip = lanes.grip[i];
        const double part = grip / __builtin_sqrt(lanes.slideSquare[i]);
        lanes.grip[i] = lanes.slips[i] == 0 ? 1.0 : (grip > 0.0 ? part : 0.0);
    }
}

template <bool still, bool slips>
inline void slow(const Rows& velocity, ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double impulse = lanes.impulse[i];
        const double part = slips ? lanes.grip[i] : 1.0;
        const long slipping = slips ? lanes.slips[i] : 0L;
        const double cx = still ? 0.0 : velocity[0][i];
        const double cy = still ? 0.0 : velocity[1][i];
        const double cz = still ? 0.0 : velocity[2][i];
        const bool stops = (slipping == 0) & (lanes.bounce[i] == 0.0) & (lanes.approach[i] < 0.0);
        const double vx = lanes.v[0][i] + impulse * lanes.normal[0][i];
        const double vy = lanes.v[1][i] + impulse * lanes.normal[1][i];
        const double vz = lanes.v[2][i] + impulse * lanes.normal[2][i];
        const double slowX = part > 0.0 ? vx - lanes.slide[0][i] * part : vx;
        const double slowY = part > 0.0 ? vy - lanes.slide[1][i] * part : vy;
        const double slowZ = part > 0.0 ? vz - lanes.slide[2][i] * part : vz;
        lanes.slide[0][i] = stops ? cx : slowX;
        lanes.slide[1][i] = stops ? cy : slowY;
        lanes.slide[2][i] = stops ? cz : slowZ;
    }
}

inline void findBacks(ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double part = lanes.back[i] / __builtin_sqrt(lanes.square[i]);
        lanes.back[i] = lanes.creeps[i] == 0 ? 1.0 : part;
    }
}

// Moves the end out of the solid. With friction it also takes `along` away. A point that friction held in its place on
// a still surface stays there to the bit.
template <bool still, bool rough, bool creeps>
inline void lift(ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double nx = lanes.normal[0][i], ny = lanes.normal[1][i], nz = lanes.normal[2][i];
        const double depth = lanes.depth[i], pressed = lanes.pressed[i], bounce = lanes.bounce[i];
        const double up = (depth > 0.0 ? depth : 0.0) + bounce * pressed;
        const double back = creeps ? lanes.back[i] : 1.0;
        const double x = lanes.end[0][i] + up * nx;
        const double y = lanes.end[1][i] + up * ny;
        const double z = lanes.end[2][i] + up * nz;
        const bool rubs = rough & (pressed > 0.0);
        const double backX = x - lanes.along[0][i] * back;
        const double backY = y - lanes.along[1][i] * back;
        const double backZ = z - lanes.along[2][i] * back;
        const double heldX = rubs ? backX : x;
        const double heldY = rubs ? backY : y;
        const double heldZ = rubs ? backZ : z;
        if (still && rough) {
            const double fromX = lanes.start[0][i], fromY = lanes.start[1][i], fromZ = lanes.start[2][i];
            const double height = nx * fromX + ny * fromY + nz * fromZ - lanes.distance[i];
            const long moves = lanes.creeps[i] | lanes.slips[i];
            const double skin = lanes.skin[i];
            const bool rests = (pressed > 0.0) & (moves == 0) & (bounce == 0.0) & (__builtin_fabs(height) <= skin);
            const long mask = rests ? -1L : 0L;
            lanes.along[0][i] = select(mask, fromX, heldX);
            lanes.along[1][i] = select(mask, fromY, heldY);
            lanes.along[2][i] = select(mask, fromZ, heldZ);
        } else {
            lanes.along[0][i] = heldX;
            lanes.along[1][i] = heldY;
            lanes.along[2][i] = heldZ;
        }
    }
}

// Takes what the touch makes of each point. A point that was touched before takes it even if there is nothing to
// report.
template <bool again>
inline void take(ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double depth = lanes.depth[i], skin = lanes.skin[i], approach = lanes.approach[i];
        const double impulse = lanes.impulse[i];
        const double x = lanes.end[0][i], y = lanes.end[1][i], z = lanes.end[2][i];
        const double vx = lanes.v[0][i], vy = lanes.v[1][i], vz = lanes.v[2][i];
        const double newX = lanes.along[0][i], newY = lanes.along[1][i], newZ = lanes.along[2][i];
        const double newVx = lanes.slide[0][i], newVy = lanes.slide[1][i], newVz = lanes.slide[2][i];
        const double arrival = depth > 0.0 ? -depth : approach;
        const double rise = depth > skin ? depth : impulse;
        const long found = lanes.outcome[i];
        const bool arrives = ((found & isNear) != 0) & (depth > -skin) & (arrival < 0.0);
        const bool touched = arrives & (rise > 0.0);
        const long mask = (again ? arrives : touched) ? -1L : 0L;
        lanes.end[0][i] = select(mask, newX, x);
        lanes.end[1][i] = select(mask, newY, y);
        lanes.end[2][i] = select(mask, newZ, z);
        lanes.v[0][i] = select(mask, newVx, vx);
        lanes.v[1][i] = select(mask, newVy, vy);
        lanes.v[2][i] = select(mask, newVz, vz);
        lanes.outcome[i] = touched ? anyTouched : found & anyLeft;
    }
}

template <class Real, bool still>
inline void respond(const ContactArgs<Real>& s, ContactLanes& lanes, const Rows& path, const Rows& velocity,
                    bool again = false) {
    press<still>(s.friction, s.restitution, s.restSpeed, path, velocity, lanes, s.n);
    const bool slips = anyOf(lanes.slips, s.n) != 0, creeps = anyOf(lanes.creeps, s.n) != 0;
    if (slips) {
        findGrips(lanes, s.n);
        slow<still, true>(velocity, lanes, s.n);
    } else {
        slow<still, false>(velocity, lanes, s.n);
    }
    if (!(s.friction > 0.0)) {
        lift<still, false, false>(lanes, s.n);
    } else if (creeps) {
        findBacks(lanes, s.n);
        lift<still, true, true>(lanes, s.n);
    } else {
        lift<still, true, false>(lanes, s.n);
    }
    if (again)
        take<true>(lanes, s.n);
    else
        take<false>(lanes, s.n);
}

}  // namespace
}  // namespace taut::collision::TAUT_ISA
