// A cone about the y axis, its middle at half its height, its tip up.
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

std::shared_ptr<const Form> makeCone(const ShapeSizes& sizes) {
    const double radius = sizes.radius;
    expectSize(radius, "cone: the radius");
    expectSize(sizes.height, "cone: the height");
    const double half = 0.5 * sizes.height;
    return byFormula<ClosedKind::cone>({radius, half, std::sqrt(radius * radius + sizes.height * sizes.height)},
                                       roundBounds(radius, half), outlineOfCone(radius, half));
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
