// What is within the radius of a piece of the y axis.
#include "taut/collision/convex_form.h"
#include "taut/collision/shape_table.h"
#include "taut/collision/shapes/shape_parts.h"

namespace taut::collision {
namespace {

struct CapsuleForm {
    double radius = 0.0;
    double halfHeight = 0.0;  // [m] from the middle to the centre of a cap

    Nearest nearest(const dvec3& p) const {
        const double y = p.y < -halfHeight ? -halfHeight : (p.y > halfHeight ? halfHeight : p.y);
        const dvec3 out(p.x, p.y - y, p.z);
        const double d = std::sqrt(glm::dot(out, out));
        return {d - radius, d > 0.0 ? out * (1.0 / d) : dvec3(1.0, 0.0, 0.0)};
    }
    Box bounds() const { return roundBounds(radius, halfHeight + radius); }
};

std::shared_ptr<const Form> makeCapsule(const ShapeSizes& sizes) {
    const double radius = sizes.radius;
    expectSize(radius, "capsule: the radius");
    expectSize(sizes.height, "capsule: the height");
    return std::make_shared<ConvexForm<CapsuleForm>>(CapsuleForm{radius, 0.5 * sizes.height});
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
