// A cylinder about the y axis.
#include <BulletCollision/CollisionShapes/btCylinderShape.h>

#include <algorithm>

#include "taut/collision/private/bullet_convex.h"
#include "taut/collision/private/shapes/shape_parts.h"

namespace taut::collision {
namespace {

// A face towards directions that are nearer to the axis than to its ends, else a line of its side.
class CylinderConvex final : public Convex {
  public:
    CylinderConvex(double radius, double half, double rounding)
        : Convex(shapeOf<btCylinderShape>({radius, half, radius}, rounding), rounding),
          radius_(radius - rounding),
          half_(half - rounding) {}
    SupportingFace faceTowards(const dvec3& d) const override {
        SupportingFace face;
        if (2.0 * d.y * d.y > 1.0) {
            addRim(radius_, d.y < 0.0 ? -half_ : half_, d, d.y > 0.0, face);
        } else {
            const dvec3 across = radius_ * acrossAxis(d);
            face.add({across.x, -half_, across.z});
            face.add({across.x, half_, across.z});
        }
        return face;
    }

    ClosedShape closed() const override {
        const dvec3 half = halfSizeOf<btCylinderShape>(*this);
        return {ClosedKind::cylinder, {half.x, half.y}};
    }

  private:
    double radius_, half_;
};

std::shared_ptr<const Convex> makeCylinder(const ShapeSizes& sizes, double rounding) {
    expectSize(sizes.radius, "cylinder: the radius");
    expectSize(sizes.height, "cylinder: the height");
    return std::make_shared<const CylinderConvex>(sizes.radius, 0.5 * sizes.height, rounding);
}

SolidShape solidCylinder(const ShapeSizes& sizes, double rounding) {
    const double radius = sizes.radius - rounding, half = 0.5 * sizes.height;
    SolidShape cylinder = prism(radius, radius, rounding - half, half - rounding);
    cylinder.properties = core::massPropertiesOfCylinder(sizes.radius, sizes.height);
    return cylinder;
}

}  // namespace

ShapeKind cylinderKind() {
    return {.name = "cylinder",
            .fields = {"radius", "height"},
            .convex = makeCylinder,
            .mesh =
                [](const ShapeSizes& sizes) {
                    return view::cylinderMesh(static_cast<float>(sizes.radius), static_cast<float>(sizes.height));
                },
            .solid = solidCylinder,
            .largestBall = [](const ShapeSizes& sizes) { return std::min(sizes.radius, 0.5 * sizes.height); }};
}

}  // namespace taut::collision
