// How the files of the shapes make their Bullet shapes. Whoever includes Bullet compiles with -ffp-contract=off, since
// half of it is inline.
#pragma once

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <memory>

#include "taut/collision/convex.h"

namespace taut::collision {

// Between metres and Bullet's units. 4096 is a power of two, so that nothing is rounded.
inline btVector3 toBullet(const dvec3& v) {
    return {Convex::unit * v.x, Convex::unit * v.y, Convex::unit * v.z};
}
inline dvec3 fromBullet(const btVector3& v) {
    return {v.x() / Convex::unit, v.y() / Convex::unit, v.z() / Convex::unit};
}

// A Bullet shape that is as large as this half size [m], with its margin inside.
template <class Shape>
std::unique_ptr<Shape> shapeOf(const dvec3& half, double rounding) {
    auto shape = std::make_unique<Shape>(toBullet(half));
    shape->setMargin(Convex::unit * rounding);
    shape->setImplicitShapeDimensions(toBullet(half - rounding));  // exactly
    return shape;
}
template <class Shape>
dvec3 halfSizeOf(const Convex& convex) {
    return fromBullet(static_cast<const Shape&>(*convex.bullet()).getHalfExtentsWithMargin());
}
// One that its margin makes larger.
template <class Shape>
std::unique_ptr<Shape> withMargin(std::unique_ptr<Shape> shape, double rounding) {
    shape->setMargin(Convex::unit * rounding);
    return shape;
}

// The circle about the axis y, of a radius and at a height [m], as a polygon. One corner is where `direction` leads.
// The corners go round counter-clockwise seen from above, or from below.
void addRim(double radius, double height, const dvec3& direction, bool isFromAbove, SupportingFace& face);

// The unit vector across the axis y in which a direction leads; x for one along the axis.
dvec3 acrossAxis(const dvec3& direction);

}  // namespace taut::collision
