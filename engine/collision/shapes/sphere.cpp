// A ball about its middle.
#include "taut/collision/convex_form.h"
#include "taut/collision/shape_table.h"
#include "taut/collision/shapes/shape_parts.h"

namespace taut::collision {
namespace {

struct SphereForm {
    double radius = 0.0;

    Nearest nearest(const dvec3& p) const {
        const double r = std::sqrt(glm::dot(p, p));
        return {r - radius, r > 0.0 ? p * (1.0 / r) : dvec3(0.0, 1.0, 0.0)};
    }
    Box bounds() const { return roundBounds(radius, radius); }
};

std::shared_ptr<const Form> makeSphere(const ShapeSizes& sizes) {
    expectSize(sizes.radius, "sphere: the radius");
    return std::make_shared<ConvexForm<SphereForm>>(SphereForm{sizes.radius});
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
