// A capsule: all places within the radius of a piece of the y axis.
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>

#include "taut/collision/private/bullet_convex.h"
#include "taut/collision/private/shapes/shape_parts.h"

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

std::shared_ptr<const Convex> makeCapsule(const ShapeSizes& sizes, double) {
    expectSize(sizes.radius, "capsule: the radius");
    expectSize(sizes.height, "capsule: the height");
    return std::make_shared<const CapsuleConvex>(sizes.radius, sizes.height);
}

SolidShape solidCapsule(const ShapeSizes& sizes, double) {
    return {.positions = {{0.0, -0.5 * sizes.height, 0.0}, {0.0, 0.5 * sizes.height, 0.0}},
            .lines = {{0, 1}},
            .sides = {{"start", {0}}, {"end", {1}}},
            .properties = core::massPropertiesOfCapsule(sizes.radius, sizes.height)};
}

}  // namespace

ShapeKind capsuleKind() {
    return {.name = "capsule",
            .fields = {"radius", "height"},
            .convex = makeCapsule,
            .mesh =
                [](const ShapeSizes& sizes) {
                    return view::capsuleMesh(static_cast<float>(sizes.radius), static_cast<float>(sizes.height));
                },
            .solid = solidCapsule,
            .largestBall = [](const ShapeSizes& sizes) { return sizes.radius; },
            .isRound = true};
}

}  // namespace taut::collision
