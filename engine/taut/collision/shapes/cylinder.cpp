// A cylinder about the y axis.
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

std::shared_ptr<const Form> makeCylinder(const ShapeSizes& sizes) {
    const double radius = sizes.radius;
    expectSize(radius, "cylinder: the radius");
    expectSize(sizes.height, "cylinder: the height");
    const double half = 0.5 * sizes.height;
    return byFormula<ClosedKind::cylinder>({radius, half}, roundBounds(radius, half), outlineOfCylinder(radius, half));
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
