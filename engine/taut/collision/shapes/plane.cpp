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

dvec3 normalOf(const ShapeSizes& sizes) {
    const double length = std::sqrt(glm::dot(sizes.normal, sizes.normal));
    if (!(length > 0.0) || !isFinite(length)) failShape("plane: its normal has no direction");
    return sizes.normal / length;
}

class PlaneConvex final : public Convex {
  public:
    explicit PlaneConvex(const dvec3& normal) : Convex(normal) {}
    SupportingFace faceTowards(const dvec3&) const override { return {}; }
};

}  // namespace

ShapeKind planeKind() {
    return {
        .name = "plane",
        .fields = {"normal"},
        .own = {},
        .isBounded = false,
        .form =
            [](const ShapeSizes& sizes) { return std::make_shared<ConvexForm<PlaneForm>>(PlaneForm{normalOf(sizes)}); },
        .mesh = [](const ShapeSizes& sizes) { return view::quadMesh(glm::vec3(sizes.normal), boardHalfSize); },
        .convex = [](const ShapeSizes& sizes, double) { return std::make_shared<const PlaneConvex>(normalOf(sizes)); }};
}

}  // namespace taut::collision
