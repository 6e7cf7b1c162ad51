// A box about its middle.
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

// Corner i is on the positive side of axis k if bit k of i is set.
Outline outlineOfBox(const dvec3& half) {
    Outline outline;
    const auto beyond = [](int i, int k) { return i ^ (1 << (k % 3)); };
    for (int i = 0; i < 8; ++i) {
        const auto side = [&](int k) { return ((i >> k) & 1) != 0 ? half[k] : -half[k]; };
        outline.vertices.emplace_back(side(0), side(1), side(2));
        outline.corners.push_back(i);
        for (int k = 0; k < 3; ++k)
            if (((i >> k) & 1) == 0) outline.edges.push_back({i, beyond(i, k), beyond(i, k + 1), beyond(i, k + 2)});
    }
    return outline;
}

std::shared_ptr<const Form> makeBox(const ShapeSizes& sizes) {
    for (int k = 0; k < 3; ++k) expectSize(sizes.halfSize[k], "box: a half size");
    const dvec3& half = sizes.halfSize;
    return byFormula<ClosedKind::box>({half.x, half.y, half.z}, {-half, half}, outlineOfBox(half));
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
                    return view::boxMesh(glm::vec3(sizes.halfSize), static_cast<float>(sizes.edge), sizes.stands);
                }};
}

}  // namespace taut::collision
