// A ball about its middle.
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include "taut/collision/private/bullet_convex.h"
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

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

std::shared_ptr<const Form> makeSphere(const ShapeSizes& sizes) {
    expectSize(sizes.radius, "sphere: the radius");
    return byFormula<ClosedKind::sphere>(SphereConvex(sizes.radius));
}

}  // namespace

ShapeKind sphereKind() {
    return {
        .name = "sphere",
        .fields = {"radius"},
        .own = {},
        .isBounded = true,
        .form = makeSphere,
        .mesh = [](const ShapeSizes& sizes) { return view::sphereMesh(static_cast<float>(sizes.radius)); },
        .convex = [](const ShapeSizes& sizes, double) { return std::make_shared<const SphereConvex>(sizes.radius); }};
}

}  // namespace taut::collision
