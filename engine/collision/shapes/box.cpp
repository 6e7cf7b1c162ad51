// A box about its middle.
#include "taut/collision/convex_form.h"
#include "taut/collision/shape_table.h"
#include "taut/collision/shapes/shape_parts.h"

namespace taut::collision {
namespace {

std::shared_ptr<const Form> makeBox(const ShapeSizes& sizes) {
    for (int k = 0; k < 3; ++k) expectSize(sizes.halfSize[k], "box: a half size");
    const dvec3& half = sizes.halfSize;
    return byFormula<ClosedKind::box>({half.x, half.y, half.z}, {-half, half});
}

}  // namespace

ShapeKind boxKind() {
    return {.name = "box",
            .fields = {"size", "edge"},
            .own = {},
            .isBounded = true,
            .form = makeBox,
            .mesh =
                [](const ShapeSizes& sizes) {
                    return view::boxMesh(glm::vec3(sizes.halfSize), static_cast<float>(sizes.edge));
                }};
}

}  // namespace taut::collision
