// Signed distances in closed form: exact everywhere, inside and outside. The axis of capsule, cylinder and cone is y.
#pragma once

#include "taut/collision/geometry.h"

namespace taut::collision {

namespace detail {

// A direction away from the y axis; on the axis itself any will do, and it is always the same one.
inline dvec3 radial(const dvec3& p, double rho) {
    return rho > 0.0 ? dvec3(p.x / rho, 0.0, p.z / rho) : dvec3(1.0, 0.0, 0.0);
}
inline double rhoOf(const dvec3& p) {
    return std::sqrt(p.x * p.x + p.z * p.z);
}
inline double signOf(double a) {
    return a < 0.0 ? -1.0 : 1.0;
}

}  // namespace detail

struct PlaneForm {
    dvec3 normal{0.0, 1.0, 0.0};

    Nearest nearest(const dvec3& p) const { return {glm::dot(normal, p), normal}; }
};

struct SphereForm {
    double radius = 0.0;

    Nearest nearest(const dvec3& p) const {
        const double r = std::sqrt(glm::dot(p, p));
        return {r - radius, r > 0.0 ? p * (1.0 / r) : dvec3(0.0, 1.0, 0.0)};
    }
};

struct BoxForm {
    dvec3 half{0.0};

    Nearest nearest(const dvec3& p) const {
        const dvec3 q = glm::abs(p) - half;
        const dvec3 sign(detail::signOf(p.x), detail::signOf(p.y), detail::signOf(p.z));
        const bool x = q.x > 0.0;
        const bool y = q.y > 0.0;
        const bool z = q.z > 0.0;
        if (x + y + z > 1) {  // nearest to an edge or a corner
            const dvec3 out = glm::max(q, dvec3(0.0));
            const double d = std::sqrt(glm::dot(out, out));
            return {d, out * sign * (1.0 / d)};
        }
        // Above one face, or inside: the face with the largest q; on a tie y, then x.
        if (q.y >= q.x && q.y >= q.z) return {q.y, {0.0, sign.y, 0.0}};
        if (q.x >= q.z) return {q.x, {sign.x, 0.0, 0.0}};
        return {q.z, {0.0, 0.0, sign.z}};
    }
};

struct CapsuleForm {
    double radius = 0.0;
    double halfHeight = 0.0;  // [m] from the middle to the centre of a cap

    Nearest nearest(const dvec3& p) const {
        const double y = p.y < -halfHeight ? -halfHeight : (p.y > halfHeight ? halfHeight : p.y);
        const dvec3 out(p.x, p.y - y, p.z);
        const double d = std::sqrt(glm::dot(out, out));
        return {d - radius, d > 0.0 ? out * (1.0 / d) : dvec3(1.0, 0.0, 0.0)};
    }
};

struct CylinderForm {
    double radius = 0.0;
    double halfHeight = 0.0;

    Nearest nearest(const dvec3& p) const {
        const double rho = detail::rhoOf(p);
        const dvec3 side = detail::radial(p, rho);
        const double up = detail::signOf(p.y);
        const double a = rho - radius;
        const double b = up * p.y - halfHeight;
        if (a > 0.0 && b > 0.0) {  // nearest to a rim
            const double d = std::sqrt(a * a + b * b);
            return {d, side * (a / d) + dvec3(0.0, up * b / d, 0.0)};
        }
        if (b >= a) return {b, {0.0, up, 0.0}};
        return {a, side};
    }
};

//          apex (0, +H/2)          In the half-plane (rho, y) the cone is a triangle:
//           |\                     its axis, its base and its side. `out` is the side's normal,
//           | \  out               `along` runs down the side from the apex.
//           |  \  ^
//           |___\ rim (R, -H/2)
struct ConeForm {
    double radius = 0.0;
    double halfHeight = 0.0;
    double slant = 1.0;  // [m] length of the side

    Nearest nearest(const dvec3& p) const {
        const double rho = detail::rhoOf(p);
        const dvec3 radial = detail::radial(p, rho);
        const double alongRho = radius / slant;
        const double alongY = -2.0 * halfHeight / slant;
        const double fromApex = p.y - halfHeight;
        const double side = -alongY * rho + alongRho * fromApex;  // height over the side
        const double run = alongRho * rho + alongY * fromApex;    // foot on the side, from the apex
        const double base = -halfHeight - p.y;                    // height under the base
        const dvec3 sideNormal = radial * -alongY + dvec3(0.0, alongRho, 0.0);

        if (side <= 0.0 && base <= 0.0) {  // inside
            if (side >= base) return {side, sideNormal};
            return {base, {0.0, -1.0, 0.0}};
        }
        if (base > 0.0 && rho <= radius) return {base, {0.0, -1.0, 0.0}};
        if (side > 0.0 && run >= 0.0 && run <= slant) return {side, sideNormal};
        const double cornerRho = run < 0.0 ? rho : rho - radius;
        const double cornerY = run < 0.0 ? fromApex : p.y + halfHeight;
        const double d = std::sqrt(cornerRho * cornerRho + cornerY * cornerY);
        return {d, radial * (cornerRho / d) + dvec3(0.0, cornerY / d, 0.0)};
    }
};

}  // namespace taut::collision
