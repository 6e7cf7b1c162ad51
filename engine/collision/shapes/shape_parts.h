// What the files of the shapes share: checks of sizes, and coordinates of what is round about y.
#pragma once

#include <string>

#include "taut/collision/geometry.h"
#include "taut/core/error.h"

namespace taut::collision {

[[noreturn]] inline void failShape(const std::string& what) {
    throw core::Error(core::ErrorKind::badContent, "collider " + what);
}

inline void expectSize(double size, const char* what) {
    if (!(size > 0.0) || !isFinite(size))
        failShape(std::string(what) + " has to be above zero, is " + std::to_string(size));
}

// The half size of a solid of revolution about y.
inline Box roundBounds(double radius, double halfHeight) {
    return {dvec3(-radius, -halfHeight, -radius), dvec3(radius, halfHeight, radius)};
}

// A direction away from the y axis; on the axis itself any will do, and it is always the same one.
inline dvec3 awayFromAxis(const dvec3& p, double rho) {
    return rho > 0.0 ? dvec3(p.x / rho, 0.0, p.z / rho) : dvec3(1.0, 0.0, 0.0);
}
inline double rhoOf(const dvec3& p) {
    return std::sqrt(p.x * p.x + p.z * p.z);
}
inline double signOf(double a) {
    return a < 0.0 ? -1.0 : 1.0;
}

}  // namespace taut::collision
