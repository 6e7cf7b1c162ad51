// The half-space behind a plane.
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"

namespace taut::collision {
namespace {

constexpr float boardHalfSize = 6.0F;  // [m] of a tilted plane, drawn as a board

struct PlaneForm {
    dvec3 normal{0.0, 1.0, 0.0};

    Nearest nearest(const dvec3& p) const { return {glm::dot(normal, p), normal}; }
    std::optional<core::Aabb> bounds() const { return std::nullopt; }
    ClosedShape closed() const { return {ClosedKind::halfSpace}; }
};

class PlaneConvex final : public Convex {
  public:
    explicit PlaneConvex(const dvec3& normal) : Convex(normal) {}
    SupportingFace faceTowards(const dvec3&) const override { return {}; }
    std::shared_ptr<const Form> form() const override {
        return std::make_shared<ConvexForm<PlaneForm>>(PlaneForm{up()});
    }
};

std::shared_ptr<const Convex> makePlane(const ShapeSizes& sizes, double) {
    const double length = std::sqrt(glm::dot(sizes.normal, sizes.normal));
    if (!(length > 0.0) || !isFinite(length)) failShape("plane: its normal has no direction");
    return std::make_shared<const PlaneConvex>(sizes.normal / length);
}

}  // namespace

ShapeKind planeKind() {
    return {.name = "plane",
            .fields = {"normal"},
            .extent = Extent::halfSpace,
            .convex = makePlane,
            .mesh = [](const ShapeSizes& sizes) { return view::quadMesh(glm::vec3(sizes.normal), boardHalfSize); }};
}

}  // namespace taut::collision
