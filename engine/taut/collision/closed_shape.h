// Convex shapes whose distance is a formula: how far a place is from the surface, and in which direction this distance
// grows fastest. Written as selections, for loops over arrays of places: one place alone gets the same bits. Plain
// data, and functions of each file's own, because kernel files are compiled once per instruction set.
#pragma once

namespace taut::collision {

enum class ClosedKind { none, halfSpace, sphere, box, capsule, cylinder, cone };

struct ClosedShape {
    ClosedKind kind = ClosedKind::none;
    // [m] A sphere has its radius; a box half of its edges; the others have radius and half height (a capsule's from
    // its middle to the centre of a cap), and a cone also the length of its side.
    double size[3] = {0.0, 0.0, 0.0};
};

// Signed, negative inside [m], and its gradient, a unit vector.
struct ClosedDistance {
    double distance, x, y, z;
};

static inline ClosedDistance distanceToSphere(const double* size, double x, double y, double z) {
    const double r = __builtin_sqrt(x * x + y * y + z * z);
    const bool isOff = r > 0.0;
    const double scale = 1.0 / r;
    return {r - size[0], isOff ? x * scale : 0.0, isOff ? y * scale : 1.0, isOff ? z * scale : 0.0};
}

static inline ClosedDistance distanceToBox(const double* size, double x, double y, double z) {
    const double qx = __builtin_fabs(x) - size[0];
    const double qy = __builtin_fabs(y) - size[1];
    const double qz = __builtin_fabs(z) - size[2];
    const double sx = x < 0.0 ? -1.0 : 1.0;
    const double sy = y < 0.0 ? -1.0 : 1.0;
    const double sz = z < 0.0 ? -1.0 : 1.0;
    const bool isOverX = qx > 0.0;
    const bool isOverY = qy > 0.0;
    const bool isOverZ = qz > 0.0;
    const bool isAtEdge = (isOverX & isOverY) | (isOverX & isOverZ) | (isOverY & isOverZ);
    const double ox = qx < 0.0 ? 0.0 : qx;
    const double oy = qy < 0.0 ? 0.0 : qy;
    const double oz = qz < 0.0 ? 0.0 : qz;
    const double d = __builtin_sqrt(ox * ox + oy * oy + oz * oz);
    const double scale = 1.0 / d;
    // Above one face, or inside: the face with the largest q; on a tie y, then x.
    const bool isY = (qy >= qx) & (qy >= qz);
    const bool isX = !isY & (qx >= qz);
    const double face = isY ? qy : (isX ? qx : qz);
    const double nx = isX ? sx : 0.0;
    const double ny = isY ? sy : 0.0;
    const double nz = (isX | isY) ? 0.0 : sz;
    return {isAtEdge ? d : face, isAtEdge ? ox * sx * scale : nx, isAtEdge ? oy * sy * scale : ny,
            isAtEdge ? oz * sz * scale : nz};
}

static inline ClosedDistance distanceToCapsule(const double* size, double x, double y, double z) {
    const double foot = y < -size[1] ? -size[1] : (y > size[1] ? size[1] : y);
    const double up = y - foot;
    const double d = __builtin_sqrt(x * x + up * up + z * z);
    const bool isOff = d > 0.0;
    const double scale = 1.0 / d;
    return {d - size[0], isOff ? x * scale : 1.0, isOff ? up * scale : 0.0, isOff ? z * scale : 0.0};
}

static inline ClosedDistance distanceToCylinder(const double* size, double x, double y, double z) {
    const double rho = __builtin_sqrt(x * x + z * z);
    const bool isOff = rho > 0.0;
    const double sideX = isOff ? x / rho : 1.0;
    const double sideZ = isOff ? z / rho : 0.0;
    const double up = y < 0.0 ? -1.0 : 1.0;
    const double a = rho - size[0];
    const double b = up * y - size[1];
    const bool isAtRim = (a > 0.0) & (b > 0.0);
    const double d = __builtin_sqrt(a * a + b * b);
    const double out = a / d;
    const bool isAtEnd = b >= a;
    const double nx = isAtEnd ? 0.0 : sideX;
    const double ny = isAtEnd ? up : 0.0;
    const double nz = isAtEnd ? 0.0 : sideZ;
    return {isAtRim ? d : (isAtEnd ? b : a), isAtRim ? sideX * out : nx, isAtRim ? up * b / d : ny,
            isAtRim ? sideZ * out : nz};
}

//          apex (0, +H/2)          In the half-plane (rho, y) the cone is a triangle:
//           |\                     its axis, its base and its side. `out` is the side's normal,
//           | \  out               `along` runs down the side from the apex.
//           |  \  ^
//           |___\ rim (R, -H/2)
static inline ClosedDistance distanceToCone(const double* size, double x, double y, double z) {
    const double rho = __builtin_sqrt(x * x + z * z);
    const bool isOff = rho > 0.0;
    const double radialX = isOff ? x / rho : 1.0;
    const double radialZ = isOff ? z / rho : 0.0;
    const double alongRho = size[0] / size[2];
    const double alongY = -2.0 * size[1] / size[2];
    const double fromApex = y - size[1];
    const double side = -alongY * rho + alongRho * fromApex;  // height over the side
    const double run = alongRho * rho + alongY * fromApex;    // foot on the side, from the apex
    const double base = -size[1] - y;                         // height under the base
    const bool isInside = (side <= 0.0) & (base <= 0.0);
    const bool isUnder = (isInside & !(side >= base)) | (!isInside & (base > 0.0) & (rho <= size[0]));
    const bool isBeside =
        (isInside & (side >= base)) | (!isInside & !isUnder & (side > 0.0) & (run >= 0.0) & (run <= size[2]));
    const bool isOverApex = run < 0.0;
    const double cornerRho = isOverApex ? rho : rho - size[0];
    const double cornerY = isOverApex ? fromApex : y + size[1];
    const double d = __builtin_sqrt(cornerRho * cornerRho + cornerY * cornerY);
    const double out = cornerRho / d;
    return {isUnder ? base : (isBeside ? side : d), isUnder ? 0.0 : (isBeside ? radialX * -alongY : radialX * out),
            isUnder ? -1.0 : (isBeside ? alongRho : cornerY / d),
            isUnder ? 0.0 : (isBeside ? radialZ * -alongY : radialZ * out)};
}

template <ClosedKind kind>
static inline ClosedDistance closedDistance(const double* size, double x, double y, double z) {
    if constexpr (kind == ClosedKind::sphere) return distanceToSphere(size, x, y, z);
    if constexpr (kind == ClosedKind::box) return distanceToBox(size, x, y, z);
    if constexpr (kind == ClosedKind::capsule) return distanceToCapsule(size, x, y, z);
    if constexpr (kind == ClosedKind::cylinder) return distanceToCylinder(size, x, y, z);
    if constexpr (kind == ClosedKind::cone) return distanceToCone(size, x, y, z);
    return {};
}

}  // namespace taut::collision
