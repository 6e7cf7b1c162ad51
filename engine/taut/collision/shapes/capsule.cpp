// A capsule: all places within the radius of a piece of the y axis.
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>

#include "taut/collision/private/bullet_convex.h"
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

class CapsuleConvex final : public Convex {
  public:
    CapsuleConvex(double radius, double height)
        : Convex(std::make_unique<btCapsuleShape>(unit * radius, unit * height), radius), half_(0.5 * height) {}
    SupportingFace faceTowards(const dvec3&) const override {
        SupportingFace axis;
        axis.add({0.0, -half_, 0.0});
        axis.add({0.0, half_, 0.0});
        return axis;
    }

    ClosedShape closed() const override {
        const auto& capsule = static_cast<const btCapsuleShape&>(*bullet());
        return {ClosedKind::capsule, {capsule.getRadius() / unit, capsule.getHalfHeight() / unit}};
    }

  private:
    double half_;
};

std::shared_ptr<const Form> makeCapsule(const ShapeSizes& sizes) {
    expectSize(sizes.radius, "capsule: the radius");
    expectSize(sizes.height, "capsule: the height");
    return byFormula<ClosedKind::capsule>(CapsuleConvex(sizes.radius, sizes.height));
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
                },
            .convex = [](const ShapeSizes& sizes,
                         double) { return std::make_shared<const CapsuleConvex>(sizes.radius, sizes.height); }};
}

}  // namespace taut::collision
