// A ball about its middle.
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

std::shared_ptr<const Form> makeSphere(const ShapeSizes& sizes) {
    expectSize(sizes.radius, "sphere: the radius");
    return byFormula<ClosedKind::sphere>({sizes.radius}, roundBounds(sizes.radius, sizes.radius),
                                         {{dvec3(0.0)}, {}, {0}, sizes.radius});
}

}  // namespace

ShapeKind sphereKind() {
    return {.name = "sphere",
            .fields = {"radius"},
            .own = {},
            .isBounded = true,
            .form = makeSphere,
            .mesh = [](const ShapeSizes& sizes) { return view::sphereMesh(static_cast<float>(sizes.radius)); }};
}

}  // namespace taut::collision
