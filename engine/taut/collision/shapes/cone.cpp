// A cone about the y axis, its middle at half its height, its tip up.
#include <BulletCollision/CollisionShapes/btConeShape.h>

#include <cmath>

#include "taut/collision/private/bullet_convex.h"
#include "taut/collision/private/shapes/shape_parts.h"

namespace taut::collision {
namespace {

// The cone inside of another whose base and side are `rounding` [m] deeper.
struct ConeCore {
    ConeCore(double radius, double height, double rounding) {
        const double side = std::sqrt(radius * radius + height * height);
        base = radius - rounding * (side + radius) / height;
        low = rounding - 0.5 * height;
        high = 0.5 * height - rounding * side / radius;
    }
    double base, low, high;  // [m] radius; along y
};

class ConeConvex final : public Convex {
  public:
    ConeConvex(const ConeCore& core, double rounding)
        : Convex(withMargin(std::make_unique<btConeShape>(unit * core.base, unit * (core.high - core.low)), rounding),
                 rounding, {0.0, 0.5 * (core.high + core.low), 0.0}),
          core_(core) {}
    // The base towards directions below it, else a line of its side.
    SupportingFace faceTowards(const dvec3& d) const override {
        SupportingFace face;
        if (d.y < 0.0 && 2.0 * d.y * d.y > 1.0) {
            addRim(core_.base, core_.low, d, false, face);
        } else {
            const dvec3 across = core_.base * acrossAxis(d);
            face.add({across.x, core_.low, across.z});
            face.add({0.0, core_.high, 0.0});
        }
        return face;
    }

    // The sides of the core's triangle are moved outwards.
    ClosedShape closed() const override {
        const auto& cone = static_cast<const btConeShape&>(*bullet());
        const double base = cone.getRadius() / unit, tall = cone.getHeight() / unit, r = rounding();
        const double side = std::sqrt(base * base + tall * tall);
        const double radius = base + r * (side + base) / tall, height = tall + r * (1.0 + side / base);
        return {ClosedKind::cone, {radius, 0.5 * height, std::sqrt(radius * radius + height * height)}};
    }

  private:
    ConeCore core_;
};

std::shared_ptr<const Convex> makeCone(const ShapeSizes& sizes, double rounding) {
    expectSize(sizes.radius, "cone: the radius");
    expectSize(sizes.height, "cone: the height");
    return std::make_shared<const ConeConvex>(ConeCore(sizes.radius, sizes.height, rounding), rounding);
}

SolidShape solidCone(const ShapeSizes& sizes, double rounding) {
    const ConeCore core(sizes.radius, sizes.height, rounding);
    SolidShape cone = prism(core.base, 0.0, core.low, core.high);
    cone.properties = core::massPropertiesOfCone(sizes.radius, sizes.height);
    return cone;
}

double ballInCone(const ShapeSizes& sizes) {
    const double radius = sizes.radius, height = sizes.height;
    return radius * height / (std::sqrt(height * height + radius * radius) + radius);
}

}  // namespace

ShapeKind coneKind() {
    return {.name = "cone",
            .fields = {"radius", "height"},
            .convex = makeCone,
            .mesh =
                [](const ShapeSizes& sizes) {
                    return view::coneMesh(static_cast<float>(sizes.radius), static_cast<float>(sizes.height));
                },
            .solid = solidCone,
            .largestBall = ballInCone};
}

}  // namespace taut::collision
