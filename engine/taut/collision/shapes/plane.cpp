// The half-space behind a plane.
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

constexpr float boardHalfSize = 6.0F;  // [m] of a tilted plane, drawn as a board

struct PlaneForm {
    dvec3 normal{0.0, 1.0, 0.0};

    Nearest nearest(const dvec3& p) const { return {glm::dot(normal, p), normal}; }
    std::optional<core::Aabb> bounds() const { return std::nullopt; }
    ClosedShape closed() const { return {ClosedKind::halfSpace}; }
};

std::shared_ptr<const Form> makePlane(const ShapeSizes& sizes) {
    const double length = std::sqrt(glm::dot(sizes.normal, sizes.normal));
    if (!(length > 0.0) || !isFinite(length)) failShape("plane: its normal has no direction");
    return std::make_shared<ConvexForm<PlaneForm>>(PlaneForm{sizes.normal / length});
}

}  // namespace

ShapeKind planeKind() {
    return {.name = "plane",
            .fields = {"normal"},
            .own = {},
            .isBounded = false,
            .form = makePlane,
            .mesh = [](const ShapeSizes& sizes) { return view::quadMesh(glm::vec3(sizes.normal), boardHalfSize); }};
}

}  // namespace taut::collision
