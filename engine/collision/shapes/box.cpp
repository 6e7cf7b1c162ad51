// A box about its middle.
#include "taut/collision/convex_form.h"
#include "taut/collision/shape_table.h"
#include "taut/collision/shapes/shape_parts.h"

namespace taut::collision {
namespace {

struct BoxForm {
    dvec3 half{0.0};

    Nearest nearest(const dvec3& p) const {
        const dvec3 q = glm::abs(p) - half;
        const dvec3 sign(signOf(p.x), signOf(p.y), signOf(p.z));
        const bool x = q.x > 0.0;
        const bool y = q.y > 0.0;
        const bool z = q.z > 0.0;
        if (x + y + z > 1) {  // nearest to an edge or a corner
            const dvec3 out = glm::max(q, dvec3(0.0));
            const double d = std::sqrt(glm::dot(out, out));
            return {d, out * sign * (1.0 / d)};
        }
        // Above one face, or inside: the face with the largest q; on a tie y, then x.
        if (q.y >= q.x && q.y >= q.z) return {q.y, {0.0, sign.y, 0.0}};
        if (q.x >= q.z) return {q.x, {sign.x, 0.0, 0.0}};
        return {q.z, {0.0, 0.0, sign.z}};
    }
    Box bounds() const { return {-half, half}; }
};

std::shared_ptr<const Form> makeBox(const ShapeSizes& sizes) {
    for (int k = 0; k < 3; ++k) expectSize(sizes.halfSize[k], "box: a half size");
    return std::make_shared<ConvexForm<BoxForm>>(BoxForm{sizes.halfSize});
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
