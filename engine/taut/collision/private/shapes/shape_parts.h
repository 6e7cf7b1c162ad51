// What the files of the shapes share: checks of sizes, and forms by a formula.
#pragma once

#include <memory>
#include <string>

#include "taut/collision/convex.h"
#include "taut/collision/private/convex_form.h"
#include "taut/core/error.h"

namespace taut::collision {

[[noreturn]] inline void failShape(const std::string& what) {
    throw core::Error(core::ErrorKind::badContent, "collider " + what);
}

inline void expectSize(double size, const char* what) {
    if (!(size > 0.0) || !isFinite(size))
        failShape(std::string(what) + " has to be above zero, is " + std::to_string(size));
}

// A convex shape whose distance is in closed_shape.h.
template <ClosedKind kind>
struct ShapeByFormula {
    ClosedShape shape;
    core::Aabb filled;

    Nearest nearest(const dvec3& p) const {
        const ClosedDistance at = closedDistance<kind>(shape.size, p.x, p.y, p.z);
        return {at.distance, {at.x, at.y, at.z}};
    }
    core::Aabb bounds() const { return filled; }
    ClosedShape closed() const { return shape; }
};

// Its numbers are those of the Bullet shape. Expects one without rounding, or a sphere or a capsule.
template <ClosedKind kind>
std::shared_ptr<const Form> byFormula(const Convex& convex) {
    using Formula = ShapeByFormula<kind>;
    return std::make_shared<ConvexForm<Formula>>(Formula{convex.closed(), *convex.bounds()});
}

}  // namespace taut::collision
