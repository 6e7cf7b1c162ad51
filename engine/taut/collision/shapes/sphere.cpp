// A ball about its middle.
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include "taut/collision/private/bullet_convex.h"
#include "taut/collision/private/shapes/shape_parts.h"

namespace taut::collision {
namespace {

class SphereConvex final : public Convex {
  public:
    explicit SphereConvex(double radius) : Convex(std::make_unique<btSphereShape>(unit * radius), radius) {}
    SupportingFace faceTowards(const dvec3&) const override {
        SupportingFace middle;
        middle.add(dvec3(0.0));
        return middle;
    }
    ClosedShape closed() const override {
        return {ClosedKind::sphere, {static_cast<const btSphereShape&>(*bullet()).getRadius() / unit}};
    }
};

std::shared_ptr<const Convex> makeSphere(const ShapeSizes& sizes, double) {
    expectSize(sizes.radius, "sphere: the radius");
    return std::make_shared<const SphereConvex>(sizes.radius);
}

}  // namespace

ShapeKind sphereKind() {
    return {.name = "sphere",
            .fields = {"radius"},
            .convex = makeSphere,
            .mesh = [](const ShapeSizes& sizes) { return view::sphereMesh(static_cast<float>(sizes.radius)); },
            .solid =
                [](const ShapeSizes& sizes, double) {
                    return SolidShape{.positions = {dvec3(0.0)},
                                      .properties = core::massPropertiesOfBall(sizes.radius)};
                },
            .largestBall = [](const ShapeSizes& sizes) { return sizes.radius; },
            .isRound = true};
}

}  // namespace taut::collision
