// A cone about the y axis, its middle at half its height, its tip up.
#include "taut/collision/convex_form.h"
#include "taut/collision/shape_table.h"
#include "taut/collision/shapes/shape_parts.h"

namespace taut::collision {
namespace {

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
        const double rho = rhoOf(p);
        const dvec3 radial = awayFromAxis(p, rho);
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
    Box bounds() const { return roundBounds(radius, halfHeight); }
};

std::shared_ptr<const Form> makeCone(const ShapeSizes& sizes) {
    const double radius = sizes.radius;
    expectSize(radius, "cone: the radius");
    expectSize(sizes.height, "cone: the height");
    return std::make_shared<ConvexForm<ConeForm>>(
        ConeForm{radius, 0.5 * sizes.height, std::sqrt(radius * radius + sizes.height * sizes.height)});
}

}  // namespace

ShapeKind coneKind() {
    return {.name = "cone",
            .fields = {"radius", "height"},
            .own = {},
            .isBounded = true,
            .form = makeCone,
            .mesh =
                [](const ShapeSizes& sizes) {
                    return view::coneMesh(static_cast<float>(sizes.radius), static_cast<float>(sizes.height));
                }};
}

}  // namespace taut::collision
