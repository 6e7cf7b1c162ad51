// A capsule: all places within the radius of a piece of the y axis.
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

std::shared_ptr<const Form> makeCapsule(const ShapeSizes& sizes) {
    const double radius = sizes.radius;
    expectSize(radius, "capsule: the radius");
    expectSize(sizes.height, "capsule: the height");
    const double half = 0.5 * sizes.height;
    return byFormula<ClosedKind::capsule>({radius, half}, roundBounds(radius, half + radius),
                                          {{{0.0, -half, 0.0}, {0.0, half, 0.0}}, {{0, 1}}, {0, 1}, radius});
}

}  // namespace

ShapeKind capsuleKind() {
    return {.name = "capsule",
            .fields = {"radius", "height"},
            .own = {},
            .isBounded = true,
            .form = makeCapsule,
            .mesh =
                [](const ShapeSizes& sizes) {
                    return view::capsuleMesh(static_cast<float>(sizes.radius), static_cast<float>(sizes.height));
                }};
}

}  // namespace taut::collision
