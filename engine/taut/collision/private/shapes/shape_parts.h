// What the files of the shapes share: checks of sizes, and forms by a formula.
#pragma once

#include <memory>
#include <string>

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

// The box of a solid of revolution about y.
inline core::Aabb roundBounds(double radius, double halfHeight) {
    return {dvec3(-radius, -halfHeight, -radius), dvec3(radius, halfHeight, radius)};
}

// A convex shape whose distance is in closed_shape.h.
template <ClosedKind kind>
struct ShapeByFormula {
    ClosedShape shape;
    core::Aabb filled;
    Outline edges{};

    Nearest nearest(const dvec3& p) const {
        const ClosedDistance at = closedDistance<kind>(shape.size, p.x, p.y, p.z);
        return {at.distance, {at.x, at.y, at.z}};
    }
    core::Aabb bounds() const { return filled; }
    ClosedShape closed() const { return shape; }
    Outline outline() const { return edges; }
};

struct FormulaSizes {
    double a = 0.0, b = 0.0, c = 0.0;
};
template <ClosedKind kind>
std::shared_ptr<const Form> byFormula(const FormulaSizes& sizes, const core::Aabb& filled, Outline edges = {}) {
    using Formula = ShapeByFormula<kind>;
    return std::make_shared<ConvexForm<Formula>>(
        Formula{{kind, {sizes.a, sizes.b, sizes.c}}, filled, std::move(edges)});
}

}  // namespace taut::collision
