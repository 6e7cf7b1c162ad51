// A cylinder about the y axis.
#include "taut/collision/convex_form.h"
#include "taut/collision/shape_table.h"
#include "taut/collision/shapes/shape_parts.h"

namespace taut::collision {
namespace {

struct CylinderForm {
    double radius = 0.0;
    double halfHeight = 0.0;

    Nearest nearest(const dvec3& p) const {
        const double rho = rhoOf(p);
        const dvec3 side = awayFromAxis(p, rho);
        const double up = signOf(p.y);
        const double a = rho - radius;
        const double b = up * p.y - halfHeight;
        if (a > 0.0 && b > 0.0) {  // nearest to a rim
            const double d = std::sqrt(a * a + b * b);
            return {d, side * (a / d) + dvec3(0.0, up * b / d, 0.0)};
        }
        if (b >= a) return {b, {0.0, up, 0.0}};
        return {a, side};
    }
    Box bounds() const { return roundBounds(radius, halfHeight); }
};

std::shared_ptr<const Form> makeCylinder(const ShapeSizes& sizes) {
    const double radius = sizes.radius;
    expectSize(radius, "cylinder: the radius");
    expectSize(sizes.height, "cylinder: the height");
    return std::make_shared<ConvexForm<CylinderForm>>(CylinderForm{radius, 0.5 * sizes.height});
}

}  // namespace

ShapeKind cylinderKind() {
    return {.name = "cylinder",
            .fields = {"radius", "height"},
            .own = {},
            .isBounded = true,
            .form = makeCylinder,
            .mesh =
                [](const ShapeSizes& sizes) {
                    return view::cylinderMesh(static_cast<float>(sizes.radius), static_cast<float>(sizes.height));
                }};
}

}  // namespace taut::collision
