// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
//
// The kernel computes the same as resolve.cpp does for one point, in the same order, in loops over a batch: where
// the path ends, its distance there, then the response (response.h). It finds out whether a path may have come through
// the solid, but not where. It leaves such points to resolve.cpp. For meshes see contact_feet.h.
#include "taut/collision/private/contact_kernel.h"

#include "taut/collision/private/contact_feet.h"
#include "taut/collision/private/contact_response.h"
#include "taut/core/private/vectorise.h"

namespace taut::collision::TAUT_ISA {
namespace {

constexpr int wholeLanes = 8;  // of the widest vector
static_assert(contactBatch + wholeLanes <= contactRow);

template <class Real, bool masked>
inline void load(const ContactArgs<Real>& s, ContactLanes& lanes) {
    const double thickness = s.thickness, skinPerMetre = s.skinPerMetre;
    TAUT_INDEPENDENT
    for (int i = 0; i < s.n; ++i) {
        const double bx = static_cast<double>(s.before[0][i]);
        const double by = static_cast<double>(s.before[1][i]);
        const double bz = static_cast<double>(s.before[2][i]);
        const double x = static_cast<double>(s.x[0][i]);
        const double y = static_cast<double>(s.x[1][i]);
        const double z = static_cast<double>(s.x[2][i]);
        const double vx = static_cast<double>(s.v[0][i]);
        const double vy = static_cast<double>(s.v[1][i]);
        const double vz = static_cast<double>(s.v[2][i]);
        const double sum = (bx + x + vx) + (by + y + vy) + (bz + z + vz);
        bool live = (static_cast<double>(s.inverseMass[i]) != 0.0) & (sum - sum == 0.0);
        if (masked) live &= s.mask[i] == s.bits;
        lanes.start[0][i] = bx;
        lanes.start[1][i] = by;
        lanes.start[2][i] = bz;
        lanes.end[0][i] = x;
        lanes.end[1][i] = y;
        lanes.end[2][i] = z;
        lanes.v[0][i] = vx;
        lanes.v[1][i] = vy;
        lanes.v[2][i] = vz;
        lanes.skin[i] = skinPerMetre * (__builtin_fabs(bx) + __builtin_fabs(by) + __builtin_fabs(bz) + thickness);
        lanes.outcome[i] = live ? isLive : 0;
    }
}

inline void toLocal(const KernelFrame& frame, const Rows& in, Rows& out, int n) {
    const double px = frame.position[0], py = frame.position[1], pz = frame.position[2];
    const double(&r)[3][3] = frame.rotation;
    const double xx = r[0][0], xy = r[0][1], xz = r[0][2];
    const double yx = r[1][0], yy = r[1][1], yz = r[1][2];
    const double zx = r[2][0], zy = r[2][1], zz = r[2][2];
    if (frame.turned) {
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) {
            const double x = in[0][i] - px, y = in[1][i] - py, z = in[2][i] - pz;
            out[0][i] = xx * x + xy * y + xz * z;
            out[1][i] = yx * x + yy * y + yz * z;
            out[2][i] = zx * x + zy * y + zz * z;
        }
    } else {
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) {
            out[0][i] = in[0][i] - px;
            out[1][i] = in[1][i] - py;
            out[2][i] = in[2][i] - pz;
        }
    }
}

// Turns local directions into the world by a turned frame. `in` and `out` may be the same.
inline void turn(const KernelFrame& frame, const Rows& in, Rows& out, int n) {
    const double(&r)[3][3] = frame.rotation;
    const double xx = r[0][0], xy = r[0][1], xz = r[0][2];
    const double yx = r[1][0], yy = r[1][1], yz = r[1][2];
    const double zx = r[2][0], zy = r[2][1], zz = r[2][2];
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double x = in[0][i], y = in[1][i], z = in[2][i];
        out[0][i] = xx * x + yx * y + zx * z;
        out[1][i] = xy * x + yy * y + zy * z;
        out[2][i] = xz * x + yz * y + zz * z;
    }
}

inline void shift(const double (&by)[3], Rows& rows, int n) {
    const double x = by[0], y = by[1], z = by[2];
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        rows[0][i] += x;
        rows[1][i] += y;
        rows[2][i] += z;
    }
}

// Turns local places into places in the world.
inline void toWorld(const KernelFrame& frame, Rows& rows, int n) {
    if (frame.turned) turn(frame, rows, rows, n);
    shift(frame.position, rows, n);
}

template <ClosedKind kind>
inline void measure(const ClosedShape& shape, const Rows& places, Row& distance, Rows& normal, int n) {
    const double size[3] = {shape.size[0], shape.size[1], shape.size[2]};
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const ClosedDistance at = closedDistance<kind>(size, places[0][i], places[1][i], places[2][i]);
        distance[i] = at.distance;
        normal[0][i] = at.x;
        normal[1][i] = at.y;
        normal[2][i] = at.z;
    }
}

inline void measureAny(const ClosedShape& shape, const Rows& places, Row& distance, Rows& normal, int n) {
    switch (shape.kind) {
        case ClosedKind::sphere: return measure<ClosedKind::sphere>(shape, places, distance, normal, n);
        case ClosedKind::box: return measure<ClosedKind::box>(shape, places, distance, normal, n);
        case ClosedKind::capsule: return measure<ClosedKind::capsule>(shape, places, distance, normal, n);
        case ClosedKind::cylinder: return measure<ClosedKind::cylinder>(shape, places, distance, normal, n);
        case ClosedKind::cone: return measure<ClosedKind::cone>(shape, places, distance, normal, n);
        case ClosedKind::none:
        case ClosedKind::halfSpace: return;
    }
}

// sweepConvex(), up to the point where it would search along the path.
inline void classify(double thickness, ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double d = lanes.distance[i];
        const double wx = lanes.localEnd[0][i] - lanes.localStart[0][i];
        const double wy = lanes.localEnd[1][i] - lanes.localStart[1][i];
        const double wz = lanes.localEnd[2][i] - lanes.localStart[2][i];
        const double along = lanes.normal[0][i] * wx + lanes.normal[1][i] * wy + lanes.normal[2][i] * wz;
        const bool live = lanes.outcome[i] != 0;
        const bool near = !(d >= thickness + lanes.skin[i]);
        const bool comesFromBehind = !(d - along >= thickness);
        const bool isShort = (d > 0.0) & (wx * wx + wy * wy + wz * wz < d * d);
        const std::int64_t nearBits = isShort ? isNear : isNear | needsStart;
        const std::int64_t farBits = comesFromBehind ? anyLeft : 0;
        lanes.outcome[i] = live ? (near ? nearBits : farBits) : 0;
    }
}

// Leaves the points that do not start on the side where they end.
inline void compareSides(ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double same = lanes.startNormal[0][i] * lanes.normal[0][i] +
                            lanes.startNormal[1][i] * lanes.normal[1][i] + lanes.startNormal[2][i] * lanes.normal[2][i];
        const bool isOther = (lanes.startDistance[i] > -lanes.skin[i]) & (same <= 0.0);
        const std::int64_t found = lanes.outcome[i];
        lanes.outcome[i] = (((found & needsStart) != 0) & isOther) ? anyLeft : found;
    }
}

// Turns the half-space in which each path has to end, `normal` and `distance` (its offset), into the world.
inline void placeOffset(const KernelFrame& to, ContactLanes& lanes, int n) {
    if (to.turned) turn(to, lanes.normal, lanes.normal, n);
    const double px = to.position[0], py = to.position[1], pz = to.position[2];
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double nx = lanes.normal[0][i], ny = lanes.normal[1][i], nz = lanes.normal[2][i];
        lanes.distance[i] += nx * px + ny * py + nz * pz;
    }
}

// Finds the half-space in which paths have to end -> `normal` (in the world) and `distance` (its offset).
inline void placeTouch(double thickness, const KernelFrame& to, ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double height = lanes.normal[0][i] * lanes.localEnd[0][i] + lanes.normal[1][i] * lanes.localEnd[1][i] +
                              lanes.normal[2][i] * lanes.localEnd[2][i];
        lanes.distance[i] = height - lanes.distance[i] + thickness;
    }
    placeOffset(to, lanes, n);
}

// Does all of this in two loops for a solid that is not turned: its frame differs from the world only by a shift.
template <ClosedKind kind>
inline void meetLevel(const ClosedShape& shape, double thickness, const double (&fromPlace)[3],
                      const double (&toPlace)[3], ContactLanes& lanes, int n) {
    const double size[3] = {shape.size[0], shape.size[1], shape.size[2]};
    const double ax = fromPlace[0], ay = fromPlace[1], az = fromPlace[2];
    const double px = toPlace[0], py = toPlace[1], pz = toPlace[2];
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double x = lanes.end[0][i] - px, y = lanes.end[1][i] - py, z = lanes.end[2][i] - pz;
        const ClosedDistance at = closedDistance<kind>(size, x, y, z);
        const double height = at.x * x + at.y * y + at.z * z;
        const double wx = x - (lanes.start[0][i] - ax);
        const double wy = y - (lanes.start[1][i] - ay);
        const double wz = z - (lanes.start[2][i] - az);
        lanes.localEnd[0][i] = at.distance;
        lanes.localEnd[1][i] = at.x * wx + at.y * wy + at.z * wz;
        lanes.localEnd[2][i] = wx * wx + wy * wy + wz * wz;
        lanes.distance[i] = height - at.distance + thickness + (at.x * px + at.y * py + at.z * pz);
        lanes.normal[0][i] = at.x;
        lanes.normal[1][i] = at.y;
        lanes.normal[2][i] = at.z;
    }
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double d = lanes.localEnd[0][i];
        const bool live = lanes.outcome[i] != 0;
        const bool near = !(d >= thickness + lanes.skin[i]);
        const bool comesFromBehind = !(d - lanes.localEnd[1][i] >= thickness);
        const bool isShort = (d > 0.0) & (lanes.localEnd[2][i] < d * d);
        const std::int64_t nearBits = isShort ? isNear : isNear | needsStart;
        const std::int64_t farBits = comesFromBehind ? anyLeft : 0;
        lanes.outcome[i] = live ? (near ? nearBits : farBits) : 0;
    }
}

inline void meetLevelAny(const ClosedShape& shape, double thickness, const double (&from)[3], const double (&to)[3],
                         ContactLanes& lanes, int n) {
    switch (shape.kind) {
        case ClosedKind::sphere: return meetLevel<ClosedKind::sphere>(shape, thickness, from, to, lanes, n);
        case ClosedKind::box: return meetLevel<ClosedKind::box>(shape, thickness, from, to, lanes, n);
        case ClosedKind::capsule: return meetLevel<ClosedKind::capsule>(shape, thickness, from, to, lanes, n);
        case ClosedKind::cylinder: return meetLevel<ClosedKind::cylinder>(shape, thickness, from, to, lanes, n);
        case ClosedKind::cone: return meetLevel<ClosedKind::cone>(shape, thickness, from, to, lanes, n);
        case ClosedKind::none:
        case ClosedKind::halfSpace: return;
    }
}

// The touch of a half-space.
inline void flatTouch(const double (&normal)[3], double offset, ContactLanes& lanes, int n) {
    const double nx = normal[0], ny = normal[1], nz = normal[2];
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double depth = offset - (nx * lanes.end[0][i] + ny * lanes.end[1][i] + nz * lanes.end[2][i]);
        const bool live = lanes.outcome[i] != 0;
        const bool near = depth > -lanes.skin[i];
        lanes.distance[i] = offset;
        lanes.normal[0][i] = nx;
        lanes.normal[1][i] = ny;
        lanes.normal[2][i] = nz;
        lanes.outcome[i] = (live & near) ? isNear : 0;
    }
}

// Finds the touched place on the surface -> position.
inline void findPlaces(double thickness, ContactLanes& lanes, int n) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Triple<double> end{lanes.end[0][i], lanes.end[1][i], lanes.end[2][i]};
        const Triple<double> normal{lanes.normal[0][i], lanes.normal[1][i], lanes.normal[2][i]};
        const Triple<double> place = placeUnder(end, normal, lanes.distance[i], thickness);
        lanes.position[0][i] = place.x;
        lanes.position[1][i] = place.y;
        lanes.position[2][i] = place.z;
    }
}

// Finds the velocity of the surface at `position`. Leaves points where the surface may be too fast.
template <class Real>
inline void findSpeeds(const ContactArgs<Real>& s, ContactLanes& lanes, Rows& velocity) {
    toLocal(s.to, lanes.position, velocity, s.n);
    toWorld(s.from, velocity, s.n);
    const double h = s.h, limit = 0.99 * s.fastest * s.fastest;
    TAUT_INDEPENDENT
    for (int i = 0; i < s.n; ++i) {
        const double x = (lanes.position[0][i] - velocity[0][i]) / h;
        const double y = (lanes.position[1][i] - velocity[1][i]) / h;
        const double z = (lanes.position[2][i] - velocity[2][i]) / h;
        const bool isFast = !(x * x + y * y + z * z <= limit);
        const std::int64_t found = lanes.outcome[i];
        velocity[0][i] = x;
        velocity[1][i] = y;
        velocity[2][i] = z;
        lanes.outcome[i] = (((found & isNear) != 0) & isFast) ? anyLeft : found;
    }
}

// Stores all points. Points without contact get their old values.
template <class Real>
inline void store(const ContactArgs<Real>& s, const ContactLanes& lanes) {
    for (int k = 0; k < 3; ++k) {
        Real *const x = s.x[k], *const v = s.v[k];
        TAUT_INDEPENDENT
        for (int i = 0; i < s.n; ++i) {
            x[i] = static_cast<Real>(lanes.end[k][i]);
            v[i] = static_cast<Real>(lanes.v[k][i]);
        }
    }
}

// Stores the points with contact, of the points that were tried several times.
template <class Real>
inline void storeTouched(const ContactArgs<Real>& s, const ContactLanes& lanes, const std::int64_t* result, int n) {
    for (int k = 0; k < 3; ++k) {
        Real *const x = s.x[k], *const v = s.v[k];
        TAUT_INDEPENDENT
        for (int i = 0; i < n; ++i) {
            const bool touched = result[i] == anyTouched;
            const double oldX = static_cast<double>(x[i]), oldV = static_cast<double>(v[i]);
            x[i] = static_cast<Real>(touched ? lanes.end[k][i] : oldX);
            v[i] = static_cast<Real>(touched ? lanes.v[k][i] : oldV);
        }
    }
}

// A piece of a batch near a mesh. Its outcomes and records go to the rows of the batch, from `at` on. A point that was
// moved off one triangle may stand near another, so there are a few passes.
template <class Real>
inline std::int64_t contactPiece(ContactArgs<Real>& s, int at, ContactLanes& lanes) {
    if (s.mask != nullptr)
        load<Real, true>(s, lanes);
    else
        load<Real, false>(s, lanes);
    const int count = s.n;
    const int n = s.n = (count + wholeLanes - 1) / wholeLanes * wholeLanes;  // whole vectors are faster than parts
    for (int i = 0; i < count; ++i) lanes.outcome[i] &= -lanes.near[at + i];
    for (int i = count; i < n; ++i) lanes.outcome[i] = 0;
    for (int i = 0; i < n; ++i) lanes.read[i] = -1;

    toLocal(s.from, lanes.start, lanes.localStart, n);
    Rows& carriedStart = lanes.startNormal;
    if (!s.still) {
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < n; ++i) carriedStart[k][i] = lanes.localStart[k][i];
        toWorld(s.to, carriedStart, n);
    }
    const Surface surface{s.still, s.friction, s.restitution, s.restSpeed};
    std::int64_t any = 0;
    for (int pass = 0; pass < mostPasses; ++pass) {
        toLocal(s.to, lanes.end, lanes.localEnd, n);
        recallFeet(s.feet, s.thickness, lanes, count);
        if ((anyOf(lanes.outcome, n) & isLost) != 0) s.feet.find(s.feet, s.thickness, count, lanes);
        readFacets(s.feet.facets, lanes, count);
        touchFeet(s.feet, s.thickness, lanes, n);
        if ((anyOf(lanes.outcome, n) & isNear) != 0) {
            placeOffset(s.to, lanes, n);
            if (!s.still || s.records) findPlaces(s.thickness, lanes, n);
            if (!s.still) findSpeeds(s, lanes, lanes.carried);
            respondAll(surface, s.still ? lanes.start : carriedStart, pass > 0, lanes, n);
        }
        const std::int64_t found = anyOf(lanes.outcome, n);
        if (found == 0) break;
        any |= found;
        if (s.records && (found & anyTouched) != 0) recordTouches(lanes, at, count);
        if (!addResults(lanes, at, count)) break;
    }
    if ((any & anyTouched) != 0) storeTouched(s, lanes, lanes.result + at, count);
    return any;
}

// Of a mesh. Neighbours in a batch are near each other, mostly: only runs of points near the surface are tried.
template <class Real>
std::int64_t contactMesh(const ContactArgs<Real>& s, ContactLanes& lanes) {
    const int n = s.n;
    findNear(s, lanes);
    for (int i = 0; i < n; ++i) lanes.result[i] = 0;
    if (s.records)
        for (int i = 0; i < n; ++i) lanes.sum[i] = 0.0;
    std::int64_t any = 0;
    for (int first = 0; first < n; ++first) {
        if (lanes.near[first] == 0) continue;
        int last = first + 1;  // a gap within the run is shorter than a vector
        for (int i = last; i < n && i <= last + wholeLanes; ++i)
            if (lanes.near[i] != 0) last = i + 1;
        ContactArgs<Real> piece = s;
        piece.n = last - first;
        for (int k = 0; k < 3; ++k) {
            piece.before[k] += first;
            piece.x[k] += first;
            piece.v[k] += first;
        }
        piece.inverseMass += first;
        if (s.mask != nullptr) piece.mask += first;
        piece.feet.first += first;
        any |= contactPiece(piece, first, lanes);
        first = last;
    }
    for (int i = 0; i < n; ++i) lanes.outcome[i] = lanes.result[i];
    if (s.records && (any & anyTouched) != 0) showRecords(lanes, n);
    return any;
}

}  // namespace

template <class Real>
std::int64_t contact(const ContactArgs<Real>& s, ContactLanes& lanes) {
    if (s.feet.finder != nullptr) return contactMesh(s, lanes);
    const int n = s.n;
    if (s.mask != nullptr)
        load<Real, true>(s, lanes);
    else
        load<Real, false>(s, lanes);
    // The touch: where each path ends, and whether it may have come through.
    if (s.shape.kind == ClosedKind::halfSpace) {
        flatTouch(s.normal, s.offset + s.thickness, lanes, n);
        if (anyOf(lanes.outcome, n) == 0) return 0;
        if (!s.still) toLocal(s.from, lanes.start, lanes.localStart, n);
    } else {
        const bool isLevel = !s.from.turned && !s.to.turned;
        if (isLevel) {
            meetLevelAny(s.shape, s.thickness, s.from.position, s.to.position, lanes, n);
        } else {
            toLocal(s.to, lanes.end, lanes.localEnd, n);
            toLocal(s.from, lanes.start, lanes.localStart, n);
            measureAny(s.shape, lanes.localEnd, lanes.distance, lanes.normal, n);
            classify(s.thickness, lanes, n);
        }
        const std::int64_t found = anyOf(lanes.outcome, n);
        if ((found & isNear) == 0) return found;
        if (isLevel && ((found & needsStart) != 0 || !s.still)) toLocal(s.from, lanes.start, lanes.localStart, n);
        if ((found & needsStart) != 0) {
            measureAny(s.shape, lanes.localStart, lanes.startDistance, lanes.startNormal, n);
            compareSides(lanes, n);
        }
        if (!isLevel) placeTouch(s.thickness, s.to, lanes, n);
    }
    // The response, on a still or a moving surface.
    const Surface surface{s.still, s.friction, s.restitution, s.restSpeed};
    if (!s.still || s.records) findPlaces(s.thickness, lanes, n);
    if (!s.still) {
        findSpeeds(s, lanes, lanes.carried);
        toWorld(s.to, lanes.localStart, n);
    }
    respondAll(surface, s.still ? lanes.start : lanes.localStart, false, lanes, n);
    const std::int64_t any = anyOf(lanes.outcome, n);
    if ((any & anyTouched) != 0) store(s, lanes);
    return any;
}
template std::int64_t contact(const ContactArgs<float>&, ContactLanes&);
template std::int64_t contact(const ContactArgs<double>&, ContactLanes&);

}  // namespace taut::collision::TAUT_ISA
