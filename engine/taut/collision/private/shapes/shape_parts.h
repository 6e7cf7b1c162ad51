// Shared by the files of the shapes: checks of sizes, and prisms.
#pragma once

#include <string>

#include "taut/collision/shape_table.h"
#include "taut/core/error.h"

namespace taut::collision {

[[noreturn]] inline void failShape(const std::string& what) {
    throw core::Error(core::ErrorKind::badContent, what);
}

inline void expectSize(double size, const char* what) {
    if (!(size > 0.0) || !isFinite(size))
        failShape(std::string(what) + " has to be above zero, is " + std::to_string(size));
}

// A prism of 24 sides with these radii at its ends, `low` and `high` on the axis y; a pyramid if the second radius is
// 0. The points of the lower end come first.
SolidShape prism(double radius, double radiusAbove, double low, double high);

}  // namespace taut::collision
